#include "src/engines/box2d/box_world.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "src/model/contact_law.h"

namespace polargrain {

namespace {

/// Way in a step [units] beyond which a grain that has left the scene is no longer Box2D's, before it is cut off.
constexpr double k_fast = 1.5;

float narrow(double value) { return static_cast<float>(value); }

/// Where a wall's own frame is, in which its points stand still.
struct WallFrame {
    Vec2 position = Vec2::Zero();
    double angle = 0.0;
};

double turning_time(const RotationMotion& motion, double time) { return std::max(0.0, time - motion.start); }

/// A turning wall has its frame in the centre of the turn, so that a steady spin alone moves it.
Vec2 frame_origin(const Wall& wall) {
    const auto* turning = std::get_if<RotationMotion>(&wall.motion);
    return turning == nullptr ? Vec2(Vec2::Zero()) : turning->centre;
}

WallFrame frame_at(const Wall& wall, double time) {
    const auto* turning = std::get_if<RotationMotion>(&wall.motion);
    if (turning == nullptr) return {wall_state(wall, time).pose.centre, 0.0};
    const double turns = turning->rate * turning_time(*turning, time) / (2.0 * k_pi);
    return {turning->centre, 2.0 * k_pi * (turns - std::floor(turns))};
}

double mean_spin(const Wall& wall, double time, double dt) {
    const auto* turning = std::get_if<RotationMotion>(&wall.motion);
    if (turning == nullptr) return 0.0;
    return turning->rate * (turning_time(*turning, time + dt) - turning_time(*turning, time)) / dt;
}

/// Filled by hand: b2PolygonShape::Set welds corners and rebuilds the hull, and makes a box of what it finds too small.
b2PolygonShape polygon_shape(const std::vector<b2Vec2>& corners) {
    b2PolygonShape shape;
    shape.m_count = static_cast<int32>(corners.size());
    b2Vec2 sum = b2Vec2_zero;
    float weight = 0.0F;
    for (std::size_t k = 0; k < corners.size(); ++k) {
        const b2Vec2& corner = corners[k];
        b2Vec2 edge = corners[(k + 1) % corners.size()] - corner;
        edge.Normalize();
        shape.m_vertices[k] = corner;
        shape.m_normals[k] = b2Cross(edge, 1.0F);
        if (k == 0 || k + 1 == corners.size()) continue;
        const b2Vec2& next = corners[k + 1];
        const float area2 = b2Cross(corner - corners[0], next - corners[0]);
        sum += area2 * (corners[0] + corner + next);
        weight += 3.0F * area2;
    }
    shape.m_centroid = (1.0F / weight) * sum;
    return shape;
}

/// Number of the first piece of each wall among all pieces, and at the end that of the first grain's.
std::vector<std::uintptr_t> number_pieces(const std::vector<Wall>& walls) {
    std::vector<std::uintptr_t> first{0};
    for (const Wall& wall : walls) first.push_back(first.back() + static_cast<std::uintptr_t>(wall.segments()));
    return first;
}

BodyIndex body_index(b2Fixture* fixture) {
    return static_cast<BodyIndex>(static_cast<std::intptr_t>(fixture->GetBody()->GetUserData().pointer));
}

PointKey key_of(b2Contact* contact, int32 point) {
    return {static_cast<std::int64_t>(contact->GetFixtureA()->GetUserData().pointer), contact->GetChildIndexA(),
            static_cast<std::int64_t>(contact->GetFixtureB()->GetUserData().pointer), contact->GetChildIndexB(),
            contact->GetManifold()->points[point].id.key};
}

bool by_key(const WarmStart& p, const WarmStart& q) { return p.key < q.key; }

}  // namespace

BoxWorld::BoxWorld(const Scene& scene, const BoxSetup& setup, const Grains& grains, double time, double dt,
                   std::vector<WarmStart> warm_starts)
    : scene_(scene),
      setup_(setup),
      world_(to_units(scene.gravity)),
      first_piece_(number_pieces(scene.walls)),
      fixtures_(first_piece_.back()),
      lowest_(largest_drop(scene).lowest),
      first_guesses_(std::move(warm_starts)) {
    const double gain = dt * std::sqrt(scene.gravity.squaredNorm());
    threshold_ = narrow(setup.settings.restitution_threshold.value_or(2.0 * gain) / setup.unit);
    world_.SetAllowSleeping(false);
    world_.SetContinuousPhysics(setup.settings.continuous);
    world_.SetContactListener(this);
    // A world without a step behind it starts all impulses from zero.
    world_.Step(narrow(dt), 1, 1);
    walls_.assign(scene.walls.size(), nullptr);
    for (std::size_t w = 0; w < scene.walls.size(); ++w) {
        if (scene.walls[w].present(time)) add_wall(static_cast<int>(w), time);
    }
    for (GrainIndex k = 0; k < grains.size(); ++k) add_grain(grains, k);
    walls_before_.resize(walls_.size());
    bodies_before_.resize(bodies_.size());
    let_go_of_fallen(dt);
}

b2Fixture* BoxWorld::add_fixture(b2Body* body, const b2Shape& shape, std::uintptr_t number) const {
    b2FixtureDef definition;
    definition.shape = &shape;
    definition.userData.pointer = number;
    definition.restitutionThreshold = threshold_;
    return body->CreateFixture(&definition);
}

void BoxWorld::add_wall(int wall, double time) {
    const auto w = static_cast<std::size_t>(wall);
    const Wall& source = scene_.walls[w];
    const WallFrame frame = frame_at(source, time);
    b2BodyDef definition;
    definition.type = source.moves() ? b2_kinematicBody : b2_staticBody;
    definition.position = to_units(frame.position);
    definition.angle = narrow(frame.angle);
    definition.userData.pointer = static_cast<std::uintptr_t>(static_cast<std::intptr_t>(wall_body(wall)));
    walls_[w] = world_.CreateBody(&definition);

    std::vector<b2Vec2> points;
    for (const Vec2& p : source.points) points.push_back(to_units(p - frame_origin(source)));
    if (source.closed()) {
        add_closed_chain(walls_[w], points, first_piece_[w]);
    } else {
        add_open_chain(walls_[w], points, first_piece_[w]);
    }
}

/// From outside a closed chain nothing is held: grains that have got half through it are pushed back in. A chain's
/// solid side is on the left of its travel and ours on the right: the points in reverse.
void BoxWorld::add_closed_chain(b2Body* body, std::vector<b2Vec2> points, std::uintptr_t number) {
    std::reverse(points.begin(), points.end());
    b2ChainShape chain;
    chain.CreateLoop(points.data(), static_cast<int32>(points.size()) - 1);
    b2Fixture* fixture = add_fixture(body, chain, number);
    fixture->GetShape()->m_radius =
        narrow(setup_.settings.skin);  // the fixture's copy of a chain comes with Box2D's own
}

/// Thin pieces that hold from both sides, as grains go round the ends of open chains.
void BoxWorld::add_open_chain(b2Body* body, const std::vector<b2Vec2>& points, std::uintptr_t number) {
    for (std::size_t k = 0; k + 1 < points.size(); ++k) {
        b2EdgeShape edge;
        edge.SetTwoSided(points[k], points[k + 1]);
        edge.m_radius = narrow(setup_.settings.skin);
        add_fixture(body, edge, number + k);
    }
}

void BoxWorld::add_grain(const Grains& grains, GrainIndex k) {
    const std::size_t i = Grains::at(k);
    b2BodyDef definition;
    definition.type = b2_dynamicBody;
    definition.position = to_units(grains.position(k));
    definition.angle = narrow(grains.angle[i]);
    definition.linearVelocity = to_units(grains.velocity(k));
    definition.angularVelocity = narrow(grains.spin[i]);
    definition.allowSleep = false;
    definition.userData.pointer = static_cast<std::uintptr_t>(k);
    b2Body* body = world_.CreateBody(&definition);
    bodies_.push_back(body);

    const float skin = narrow(setup_.settings.skin);
    if (const auto* disk = std::get_if<Disk>(&scene_.shape(grains.shape[i]))) {
        b2CircleShape circle;
        circle.m_radius = narrow(disk->radius() / setup_.unit) + skin;
        add_fixture(body, circle, fixtures_++);
    }
    for (const ConvexPiece& piece : setup_.pieces[static_cast<std::size_t>(grains.shape[i])]) {
        std::vector<b2Vec2> corners;
        for (const Vec2& corner : piece) corners.push_back(to_units(corner));
        b2PolygonShape polygon = polygon_shape(corners);
        polygon.m_radius = skin;
        add_fixture(body, polygon, fixtures_++);
    }
    b2MassData mass;
    mass.mass = narrow(grains.mass[i]);
    mass.center = b2Vec2_zero;
    mass.I = narrow(grains.inertia[i] / (setup_.unit * setup_.unit));
    body->SetMassData(&mass);
}

void BoxWorld::step(double time, double dt) {
    place_walls(time, dt);
    remember_poses();
    impulses_.clear();
    world_.Step(narrow(dt), setup_.settings.velocity_iterations, setup_.settings.position_iterations);
    first_guesses_.clear();
    fly_fallen(dt);
    let_go_of_fallen(dt);
}

bool BoxWorld::has_fallen(GrainIndex k, double dt) const {
    const b2Body& body = *bodies_[Grains::at(k)];
    const Vec2 velocity = to_metres(body.GetLinearVelocity());
    if (std::sqrt(velocity.squaredNorm()) * dt < k_fast * setup_.unit || velocity.dot(scene_.gravity) <= 0.0)
        return false;
    const Vec2 up = -unit(scene_.gravity);
    return up.dot(to_metres(body.GetPosition())) + outer_radius(scene_.shape_of(k)) < lowest_;
}

void BoxWorld::let_go_of_fallen(double dt) {
    if (scene_.gravity == Vec2::Zero()) return;
    for (GrainIndex k = 0; k < static_cast<GrainIndex>(bodies_.size()); ++k) {
        b2Body* body = bodies_[Grains::at(k)];
        if (body->IsEnabled() && has_fallen(k, dt)) body->SetEnabled(false);
    }
}

/// By Box2D's own rule: the new velocity moves.
void BoxWorld::fly_fallen(double dt) {
    const float h = narrow(dt);
    for (b2Body* body : bodies_) {
        if (body->IsEnabled()) continue;
        const b2Vec2 velocity = body->GetLinearVelocity() + h * world_.GetGravity();
        body->SetLinearVelocity(velocity);
        body->SetTransform(body->GetPosition() + h * velocity, body->GetAngle() + h * body->GetAngularVelocity());
    }
}

void BoxWorld::place_walls(double time, double dt) {
    for (std::size_t w = 0; w < walls_.size(); ++w) {
        const Wall& wall = scene_.walls[w];
        if (walls_[w] == nullptr) continue;
        if (!wall.present(time)) {
            world_.DestroyBody(walls_[w]);
            walls_[w] = nullptr;
            continue;
        }
        if (!wall.moves()) continue;
        // Where it should be, not where velocities in single precision have brought it; with the mean velocity it ends
        // where it should be too.
        const WallFrame now = frame_at(wall, time);
        const WallFrame then = frame_at(wall, time + dt);
        walls_[w]->SetTransform(to_units(now.position), narrow(now.angle));
        walls_[w]->SetLinearVelocity(to_units((then.position - now.position) / dt));
        walls_[w]->SetAngularVelocity(narrow(mean_spin(wall, time, dt)));
    }
}

void BoxWorld::remember_poses() {
    for (std::size_t w = 0; w < walls_.size(); ++w) {
        if (walls_[w] != nullptr) walls_before_[w] = walls_[w]->GetTransform();
    }
    for (std::size_t k = 0; k < bodies_.size(); ++k) bodies_before_[k] = bodies_[k]->GetTransform();
}

const b2Transform& BoxWorld::pose_before(BodyIndex body) const {
    return is_wall(body) ? walls_before_[static_cast<std::size_t>(wall_index(body))] : bodies_before_[Grains::at(body)];
}

void BoxWorld::give(Grains& grains) const {
    for (GrainIndex k = 0; k < grains.size(); ++k) {
        const b2Body* body = bodies_[Grains::at(k)];
        grains.set_position(k, to_metres(body->GetPosition()));
        grains.angle[Grains::at(k)] = body->GetAngle();
        grains.set_velocity(k, to_metres(body->GetLinearVelocity()));
        grains.spin[Grains::at(k)] = body->GetAngularVelocity();
    }
}

std::vector<WarmStart> BoxWorld::warm_starts() {
    if (!first_guesses_.empty()) return first_guesses_;
    std::vector<WarmStart> starts;
    for (b2Contact* contact = world_.GetContactList(); contact != nullptr; contact = contact->GetNext()) {
        const b2Manifold* manifold = contact->GetManifold();
        for (int32 p = 0; p < manifold->pointCount; ++p) {
            const b2ManifoldPoint& point = manifold->points[p];
            starts.push_back({key_of(contact, p), point.normalImpulse, point.tangentImpulse});
        }
    }
    std::sort(starts.begin(), starts.end(), by_key);
    return starts;
}

Vec2 BoxWorld::wall_velocity(int wall, const Vec2& point) const {
    const b2Body* body = walls_[static_cast<std::size_t>(wall)];
    return to_metres(body->GetLinearVelocityFromWorldPoint(to_units(point)));
}

GrainIndex BoxWorld::cut_off(double dt) const {
    constexpr float k_nearly = 0.999F;
    const float h = narrow(dt);
    for (std::size_t k = 0; k < bodies_.size(); ++k) {
        if (!bodies_[k]->IsEnabled()) continue;
        const bool too_fast = h * bodies_[k]->GetLinearVelocity().Length() > k_nearly * b2_maxTranslation;
        const bool spins_too_fast = h * std::abs(bodies_[k]->GetAngularVelocity()) > k_nearly * b2_maxRotation;
        if (too_fast || spins_too_fast) return static_cast<GrainIndex>(k);
    }
    return -1;
}

void BoxWorld::BeginContact(b2Contact* contact) {
    const auto [a, b] = std::minmax({body_index(contact->GetFixtureA()), body_index(contact->GetFixtureB())});
    contact->SetFriction(narrow(pair_law(scene_, a, b).friction));
    contact->SetRestitution(narrow(mean_restitution(scene_, a, b)));
}

void BoxWorld::PreSolve(b2Contact* contact, const b2Manifold*) {
    if (first_guesses_.empty()) return;
    b2Manifold* manifold = contact->GetManifold();
    for (int32 p = 0; p < manifold->pointCount; ++p) {
        const WarmStart wanted{key_of(contact, p)};
        const auto found = std::lower_bound(first_guesses_.begin(), first_guesses_.end(), wanted, by_key);
        if (found == first_guesses_.end() || found->key != wanted.key) continue;
        manifold->points[p].normalImpulse = narrow(found->normal);
        manifold->points[p].tangentImpulse = narrow(found->tangent);
    }
}

void BoxWorld::PostSolve(b2Contact* contact, const b2ContactImpulse* impulse) {
    const BodyIndex body_a = body_index(contact->GetFixtureA());
    const BodyIndex body_b = body_index(contact->GetFixtureB());
    const float radius_a = contact->GetFixtureA()->GetShape()->m_radius;
    const float radius_b = contact->GetFixtureB()->GetShape()->m_radius;
    b2WorldManifold before, after;
    before.Initialize(contact->GetManifold(), pose_before(body_a), radius_a, pose_before(body_b), radius_b);
    contact->GetWorldManifold(&after);
    const double side = body_a < body_b ? 1.0 : -1.0;
    for (int32 p = 0; p < impulse->count; ++p) {
        const float normal = impulse->normalImpulses[p];
        const float tangent = impulse->tangentImpulses[p];
        if (normal == 0.0F && tangent == 0.0F) continue;
        PointImpulse entry;
        std::tie(entry.a, entry.b) = std::minmax(body_a, body_b);
        entry.point_before = to_metres(before.points[p]);
        entry.normal_before = side * Vec2(before.normal.x, before.normal.y);
        entry.point = to_metres(after.points[p]);
        entry.normal = side * Vec2(after.normal.x, after.normal.y);
        entry.gap = setup_.unit * (static_cast<double>(after.separations[p]) + 2.0 * setup_.settings.skin);
        entry.along_normal = setup_.unit * static_cast<double>(normal);
        entry.along_tangent = setup_.unit * static_cast<double>(tangent);
        impulses_.push_back(entry);
    }
}

}  // namespace polargrain
