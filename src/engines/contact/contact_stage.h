#pragma once

#include <vector>

#include "src/engines/contact/impact_law.h"
#include "src/engines/contact/recorded_contact.h"
#include "src/model/scene.h"
#include "src/model/step_report.h"

namespace polargrain {

/// Turns recorded contacts into impacts: highest closing speed first; after each, the closing speeds of all contacts
/// that share a grain with it are computed again, until none closes. [HN94, sec. 3.6]
///
/// The paper sets no end to this; here a contact is used at most k_most_uses times a step, so that a grain that
/// chatters between two others cannot hold the step up, and a closing speed below k_least_closing of what gravity
/// gives in a step counts as resting.
class ContactStage {
public:
    static constexpr int k_most_uses = 10;
    static constexpr double k_least_closing = 1e-6;

    explicit ContactStage(const Scene& scene);

    /// Changes the velocities of world.grains; adds impulses, losses and wall work to the report.
    void process(const std::vector<RecordedContact>& contacts, World& world, double dt, StepReport& report);

private:
    /// Everything about a contact that does not change while velocities do.
    struct Prepared {
        ContactFrame frame;
        double friction;
        double restitution;
        int uses;
        std::int32_t stamp;  ///< of its newest entry in the queue
        Vec2 impulse;        ///< on b so far
    };
    struct Queued {
        double closing_speed;
        std::int32_t contact;
        std::int32_t stamp;
    };

    void prepare(const std::vector<RecordedContact>& contacts, World& world);
    void queue(const RecordedContact& contact, std::size_t k, const Grains& grains);
    void exchange(const RecordedContact& contact, Prepared& prepared, World& world, StepReport& report);
    Motion motion_of(BodyIndex body, const Grains& grains) const;
    ImpactBody inertia_of(BodyIndex body, const Grains& grains) const;

    const Scene& scene_;
    double least_closing_ = 0.0;
    std::vector<Motion> walls_;
    std::vector<Prepared> prepared_;
    std::vector<Queued> heap_;
    std::vector<std::int32_t> first_of_grain_, fill_, of_grain_;
};

}  // namespace polargrain
