#include "src/engines/contact/contact_1994.h"

#include <algorithm>

#include "src/engines/contact/contact_stage.h"
#include "src/engines/contact/motion_update.h"
#include "src/engines/contact/trial_check.h"

namespace polargrain {

namespace {

class Contact1994 final : public Engine {
public:
    explicit Contact1994(const Scene& scene) : scene_(scene), contact_stage_(scene), trial_check_(scene) {}

    std::string_view name() const override { return "contact-1994"; }
    double suggested_dt() const override { return critical_time_step(scene_); }

    void step(World& world, double dt, StepReport& report) override {
        report.clear(scene_.walls.size());
        forget_removed_walls(world.time);
        contact_stage_.process(contacts_, world, dt, report);
        take_trial(world.grains, scene_.gravity, dt, configuration_);
        const double trial_time = static_cast<double>(world.step + 1) * dt;
        trial_check_.run(configuration_, world.grains, world.time, trial_time, contacts_);
        const std::vector<char>& rejected = motion_update_.decide(trial_check_.overlaps());
        trial_check_.record(configuration_, world.grains, rejected, contacts_);
        move(world.grains, rejected, report);
        ++world.step;
        world.time = trial_time;
    }

    void save(Checkpoint& checkpoint) const override;
    void load(const Checkpoint& checkpoint) override;

private:
    void forget_removed_walls(double time) {
        std::erase_if(contacts_, [&](const RecordedContact& c) {
            return is_wall(c.a) && !scene_.walls[static_cast<std::size_t>(wall_index(c.a))].present(time);
        });
    }

    /// [HN94, Fig. 8, step 7] Free flight keeps the energy of a grain that moves; one that stays has been given
    /// gravity's work without the way, which is what this method creates.
    void move(Grains& grains, const std::vector<char>& rejected, StepReport& report) const {
        for (GrainIndex k = 0; k < grains.size(); ++k) {
            const std::size_t i = Grains::at(k);
            const Vec2 way = configuration_.trial[i].centre - configuration_.current[i].centre;
            ++report.moves.tried;
            if (rejected[i]) {
                ++report.moves.rejected;
                report.ledger.created += grains.mass[i] * scene_.gravity.dot(way);
            } else {
                grains.set_position(k, configuration_.trial[i].centre);
                grains.angle[i] = configuration_.trial_angle[i];
            }
        }
        report.ledger.rises = std::max(0.0, report.ledger.created);
    }

    const Scene& scene_;
    ContactStage contact_stage_;
    TrialCheck trial_check_;
    MotionUpdate motion_update_;
    TrialConfiguration configuration_;
    std::vector<RecordedContact> contacts_;
};

constexpr std::size_t k_reals_per_contact = 9;

void Contact1994::save(Checkpoint& checkpoint) const {
    std::vector<std::int64_t> bodies;
    std::vector<double> reals;
    for (const RecordedContact& c : contacts_) {
        bodies.insert(bodies.end(), {c.a, c.b});
        reals.insert(reals.end(), {c.point.x(), c.point.y(), c.normal.x(), c.normal.y(), c.centre_a.x(), c.centre_a.y(),
                                   c.centre_b.x(), c.centre_b.y(), c.depth});
    }
    checkpoint.put("contact-1994/bodies", std::move(bodies));
    checkpoint.put("contact-1994/contacts", std::move(reals));
}

void Contact1994::load(const Checkpoint& checkpoint) {
    const auto& bodies = checkpoint.integers("contact-1994/bodies");
    const auto& reals = checkpoint.reals("contact-1994/contacts");
    contacts_.clear();
    for (std::size_t k = 0; 2 * k < bodies.size(); ++k) {
        const double* r = reals.data() + k_reals_per_contact * k;
        contacts_.push_back({static_cast<BodyIndex>(bodies[2 * k]),
                             static_cast<BodyIndex>(bodies[2 * k + 1]),
                             {r[0], r[1]},
                             {r[2], r[3]},
                             {r[4], r[5]},
                             {r[6], r[7]},
                             r[8]});
    }
}

}  // namespace

std::unique_ptr<Engine> make_contact_1994(const Scene& scene) { return std::make_unique<Contact1994>(scene); }

}  // namespace polargrain
