#include "src/engines/box2d/box2d_engine.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "src/core/error.h"
#include "src/engines/box2d/box_world.h"
#include "src/engines/box2d/motion_state.h"
#include "src/engines/box2d/step_account.h"

namespace polargrain {

namespace {

/// Steps between two rebuildings of Box2D's world; see Box2dEngine.
constexpr std::int64_t k_rebuild_every = 128;
/// Depth up to which Box2D leaves shapes in one another, skins included [units]; b2_linearSlop without its rounding.
constexpr double k_slop = 0.005;
/// Largest way of a grain in a step [units] that the engine vouches for: half of where Box2D cuts off.
constexpr double k_longest_way = 1.0;

double largest_diameter(const Scene& scene) {
    double largest = 0.0;
    for (GrainIndex k = 0; k < scene.grains.size(); ++k)
        largest = std::max(largest, 2.0 * outer_radius(scene.shape_of(k)));
    return largest;
}

/// What the engine knows beside the World: enough to take the next step as if it had never stopped.
struct Memory {
    std::int64_t step = 0;                   ///< steps taken when this was written
    std::int64_t built_at = 0;               ///< step at which Box2D's world was built
    double dt = 0.0;                         ///< [s] of the steps since then
    MotionState built_from;                  ///< state at that step
    std::vector<WarmStart> built_with, now;  ///< impulses that the step then, and the next one, begin with
};

/// Box2D does not give away all that its next step depends on: the order of its contacts and the tree that finds them
/// are its own. So its world is built anew, from the state and the impulses alone, at every k_rebuild_every-th step,
/// and whenever it is handed another state or another dt than it expects. A checkpoint holds the state at the last
/// building; loading it takes the steps since then once more, which leads to the same bits.
class Box2dEngine final : public Engine {
public:
    Box2dEngine(const Scene& scene, const Box2dSettings& settings)
        : scene_(scene), setup_{box2d_unit(scene, settings), settings, {}} {
        for (const Wall& wall : scene.walls) check_pieces(wall);
    }

    std::string_view name() const override { return "box2d"; }
    std::vector<std::string> notes() const override;

    double suggested_dt() const override {
        return std::min(critical_time_step(scene_), k_longest_way * setup_.unit / largest_speed(scene_));
    }

    void check_dt(double dt) const override {
        const double speed = largest_speed(scene_);
        const double way = speed * dt / setup_.unit;
        if (way < static_cast<double>(b2_maxTranslation)) return;
        throw InputError(fmt::format(
            "box2d: at up to {:.3g} m/s a grain moves {:.3g} of Box2D's units of {:.4g} m in a step of {:.4g} s, and "
            "Box2D cuts off at {}; use run.time_step = {:.2g} or less",
            speed, way, setup_.unit, dt, b2_maxTranslation, k_longest_way * setup_.unit / speed));
    }

    void step(World& world, double dt, StepReport& report) override {
        report.clear(scene_.walls.size());
        if (loaded_) restore(world, dt);
        if (!fits(world, dt)) build(world, dt);
        advance(world, dt);
        account(scene_, *box_, before_, world.grains, dt, report);
    }

    void save(Checkpoint& checkpoint) const override;
    void load(const Checkpoint& checkpoint) override;

private:
    /// InputError where Box2D would take the ends of a piece of a closed chain for one point, and end the program.
    void check_pieces(const Wall& wall) const;
    Memory memory() const;

    bool fits(const World& world, double dt) const {
        return box_ && dt == dt_ && world.step == step_ && world.step % k_rebuild_every != 0 &&
               left_.same_as(world.grains);
    }

    void build(const World& world, double dt) {
        check_dt(dt);
        if (setup_.pieces.empty()) cut_into_pieces();
        built_with_ = box_ ? box_->warm_starts() : std::move(impulses_);
        impulses_.clear();
        built_from_ = MotionState::of(world.grains);
        built_at_ = world.step;
        dt_ = dt;
        box_ = std::make_unique<BoxWorld>(scene_, setup_, world.grains, world.time, dt, built_with_);
    }

    void advance(World& world, double dt) {
        before_ = MotionState::of(world.grains);
        box_->step(world.time, dt);
        box_->give(world.grains);
        left_ = MotionState::of(world.grains);
        ++world.step;
        world.time = static_cast<double>(world.step) * dt;
        step_ = world.step;
        if (const GrainIndex k = box_->cut_off(dt); k >= 0) {
            throw RunError(fmt::format(
                "box2d: at t = {:.4g} s grain {} moves faster than Box2D allows, {} units or a quarter turn in a step; "
                "use run.time_step = {:.2g}",
                world.time, k, b2_maxTranslation, 0.5 * dt));
        }
    }

    /// From a checkpoint: takes the steps since the world was built again. Where the run does not go on from there (it
    /// has been settled, and starts now), only the impulses are carried over.
    void restore(const World& world, double dt) {
        const Memory memory = std::move(*loaded_);
        loaded_.reset();
        box_.reset();
        if (memory.step == world.step && memory.dt == dt) {
            World replayed = world;
            memory.built_from.put(replayed.grains);
            replayed.step = memory.built_at;
            replayed.time = static_cast<double>(replayed.step) * dt;
            impulses_ = memory.built_with;
            build(replayed, dt);
            while (replayed.step < memory.step) advance(replayed, dt);
            if (left_.same_as(world.grains)) return;
            box_.reset();
        }
        impulses_ = memory.now;
    }

    void cut_into_pieces() {
        setup_.pieces.resize(scene_.shapes.size());
        for (std::size_t s = 0; s < scene_.shapes.size(); ++s) {
            const auto* polygon = std::get_if<PolarPolygon>(scene_.shapes[s].get());
            if (polygon != nullptr) setup_.pieces[s] = convex_pieces(*polygon, b2_maxPolygonVertices);
        }
    }

    const Scene& scene_;
    BoxSetup setup_;
    std::unique_ptr<BoxWorld> box_;
    std::optional<Memory> loaded_;     ///< not yet used
    std::vector<WarmStart> impulses_;  ///< for the next building, where there is no world to ask
    std::int64_t step_ = 0;            ///< of the world as it was left
    MotionState left_, before_;        ///< as the last step left and found it
    std::int64_t built_at_ = 0;
    double dt_ = 0.0;
    MotionState built_from_;
    std::vector<WarmStart> built_with_;
};

void Box2dEngine::check_pieces(const Wall& wall) const {
    const double least = 2.0 * k_slop * setup_.unit;
    for (std::size_t k = 1; wall.closed() && k < wall.points.size(); ++k) {
        const double length = std::sqrt((wall.points[k] - wall.points[k - 1]).squaredNorm());
        require(
            length > least,
            "box2d: wall \"{}\", piece {}: {:.3g} m long, and a piece of a closed chain must be longer than {:.3g} m "
            "here, as Box2D takes nearer points for one; leave one of its ends out",
            wall.name, k, length, least);
    }
}

std::vector<std::string> Box2dEngine::notes() const {
    std::vector<std::string> notes{
        fmt::format(
            "Box2D counts in units of {:.6g} m, in single precision; outlines rest {:.3g} to {:.3g} m apart and "
            "overlap where they have been pressed together",
            setup_.unit, box2d_resting_gap(scene_, setup_.settings), 2.0 * setup_.settings.skin * setup_.unit),
        "restitution is Newton's (speeds of the contact point), not energetic; " +
            (setup_.settings.restitution_threshold
                 ? fmt::format("impacts slower than {:.3g} m/s do not bounce", *setup_.settings.restitution_threshold)
                 : "impacts slower than twice g times the step do not bounce"),
        "impacts are not described one by one: impacts.csv would stay empty"};
    const auto scatters = [](const Restitution& r) { return r.stddev > 0.0; };
    for (MaterialIndex a = 0; a < scene_.materials.size(); ++a) {
        bool any = scatters(scene_.materials[a].restitution);
        for (MaterialIndex b = a; b < scene_.materials.size(); ++b) {
            const auto& own = scene_.materials.pair(a, b).restitution;
            any = any || (own && scatters(*own));
        }
        if (any) {
            notes.push_back(fmt::format("the scatter of the restitution of \"{}\" is left out: its mean holds",
                                        scene_.materials[a].name));
        }
    }
    return notes;
}

// --- checkpoints ---

constexpr std::size_t k_key_size = std::tuple_size_v<PointKey>;

void put_impulses(Checkpoint& checkpoint, const std::string& name, const std::vector<WarmStart>& starts) {
    std::vector<std::int64_t> keys;
    std::vector<double> impulses;
    for (const WarmStart& start : starts) {
        keys.insert(keys.end(), start.key.begin(), start.key.end());
        impulses.insert(impulses.end(), {start.normal, start.tangent});
    }
    checkpoint.put("box2d/" + name + "/keys", std::move(keys));
    checkpoint.put("box2d/" + name + "/impulses", std::move(impulses));
}

std::vector<WarmStart> get_impulses(const Checkpoint& checkpoint, const std::string& name) {
    const auto& keys = checkpoint.integers("box2d/" + name + "/keys");
    const auto& impulses = checkpoint.reals("box2d/" + name + "/impulses");
    std::vector<WarmStart> starts(impulses.size() / 2);
    for (std::size_t k = 0; k < starts.size(); ++k) {
        for (std::size_t n = 0; n < k_key_size; ++n) starts[k].key[n] = keys.at(k_key_size * k + n);
        starts[k].normal = impulses[2 * k];
        starts[k].tangent = impulses[2 * k + 1];
    }
    return starts;
}

Memory Box2dEngine::memory() const {
    if (loaded_) return *loaded_;
    if (!box_) return {.step = -1, .built_at = -1, .dt = 0.0, .built_from = {}, .built_with = {}, .now = impulses_};
    return {step_, built_at_, dt_, built_from_, built_with_, box_->warm_starts()};
}

void Box2dEngine::save(Checkpoint& checkpoint) const {
    const Memory memory = this->memory();
    const MotionState& from = memory.built_from;
    checkpoint.put("box2d/steps", std::vector<std::int64_t>{memory.step, memory.built_at});
    checkpoint.put("box2d/dt", std::vector<double>{memory.dt});
    checkpoint.put("box2d/x", from.x);
    checkpoint.put("box2d/y", from.y);
    checkpoint.put("box2d/angle", from.angle);
    checkpoint.put("box2d/vx", from.vx);
    checkpoint.put("box2d/vy", from.vy);
    checkpoint.put("box2d/spin", from.spin);
    put_impulses(checkpoint, "built_with", memory.built_with);
    put_impulses(checkpoint, "now", memory.now);
}

void Box2dEngine::load(const Checkpoint& checkpoint) {
    Memory memory;
    memory.step = checkpoint.integers("box2d/steps").at(0);
    memory.built_at = checkpoint.integers("box2d/steps").at(1);
    memory.dt = checkpoint.reals("box2d/dt").at(0);
    memory.built_from = {checkpoint.reals("box2d/x"),  checkpoint.reals("box2d/y"),  checkpoint.reals("box2d/angle"),
                         checkpoint.reals("box2d/vx"), checkpoint.reals("box2d/vy"), checkpoint.reals("box2d/spin")};
    memory.built_with = get_impulses(checkpoint, "built_with");
    memory.now = get_impulses(checkpoint, "now");
    loaded_ = std::move(memory);
}

}  // namespace

std::unique_ptr<Engine> make_box2d(const Scene& scene, const Box2dSettings& settings) {
    return std::make_unique<Box2dEngine>(scene, settings);
}

std::unique_ptr<Engine> make_box2d(const Scene& scene) { return make_box2d(scene, Box2dSettings{}); }

double box2d_unit(const Scene& scene, const Box2dSettings& settings) {
    if (settings.unit) return *settings.unit;
    const double largest = largest_diameter(scene);
    if (!(largest > 0.0)) return 1.0;
    // largest / unit in (4, 8].
    int exponent = 0;
    const double mantissa = std::frexp(largest, &exponent);  // in [0.5, 1)
    return std::ldexp(1.0, mantissa > 0.5 ? exponent - 3 : exponent - 4);
}

double box2d_resting_gap(const Scene& scene, const Box2dSettings& settings) {
    return box2d_unit(scene, settings) * (2.0 * settings.skin - k_slop);
}

}  // namespace polargrain
