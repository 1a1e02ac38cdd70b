#include "src/engines/dem/soft_law.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "src/core/elementary.h"
#include "src/core/error.h"
#include "src/engines/dem/normal_law.h"
#include "src/engines/dem/tangential_law.h"

namespace polargrain {

namespace {

/// Restitutions below this count as this much: a dashpot that lets nothing back needs infinite force.
constexpr double k_least_restitution = 0.01;

/// An impact on the whole of the widest face is rare, and may take that much fewer steps.
constexpr double k_coarser_on_faces = 2.5;

/// Step over the time 1 / (s (gamma + sqrt(gamma^2 - 1))) in which a dashpot above critical damping stops two bodies, s
/// being their frequency. From 1 on an explicit scheme throws them back; at half of it a restitution below 0.05 comes
/// out to 0.015, and grains with two such contacts are stable still.
constexpr double k_step_over_decay = 0.5;

/// A random restitution is rarely less than its mean by more standard deviations than that.
constexpr double k_deviations = 3.0;

double exponent_of(const SoftLaw& law) {
    switch (law.normal) {
        case NormalLaw::hertz: return 0.5;
        case NormalLaw::power: return law.exponent;
        case NormalLaw::linear:
        case NormalLaw::walton_braun: return 0.0;
    }
    return 0.0;
}

const SoftLaw& law_of_pair(const DemSettings& settings, MaterialIndex a, MaterialIndex b) {
    for (const SoftPair& pair : settings.pairs) {
        if ((pair.a == a && pair.b == b) || (pair.a == b && pair.b == a)) return pair.law;
    }
    return settings.law;
}

bool has_polygons(const Scene& scene) {
    for (GrainIndex k = 0; k < scene.grains.size(); ++k) {
        if (std::holds_alternative<PolarPolygon>(scene.shape_of(k))) return true;
    }
    return false;
}

double least_restitution(const Scene& scene) {
    double least = 1.0;
    for (MaterialIndex a = 0; a < scene.materials.size(); ++a) {
        least = std::min(least, scene.materials[a].restitution.mean);
        for (MaterialIndex b = 0; b < scene.materials.size(); ++b) {
            const auto& own = scene.materials.pair(a, b).restitution;
            if (own) least = std::min(least, own->mean);
        }
    }
    return std::max(least, k_least_restitution);
}

/// Least restitution of a grain of material a against material b, as far as a decides it.
double least_restitution(const Scene& scene, MaterialIndex a, MaterialIndex b) {
    const auto& own = scene.materials.pair(a, b).restitution;
    const Restitution& restitution = own ? *own : scene.materials[a].restitution;
    return restitution.mean - k_deviations * restitution.stddev;
}

/// 1 / (s t) with the time t in which a dashpot of the ratio gamma stops two bodies of the frequency s; 0 where none
/// does before they turn.
double decay_over_frequency(double gamma) { return gamma > 1.0 ? gamma + std::sqrt(gamma * gamma - 1.0) : 0.0; }

}  // namespace

SoftLaws::SoftLaws(const Scene& scene, const DemSettings& settings)
    : materials_(static_cast<std::size_t>(scene.materials.size())) {
    double smallest = std::numeric_limits<double>::infinity();
    for (GrainIndex k = 0; k < scene.grains.size(); ++k) {
        const double inner = inner_radius(scene.shape_of(k));
        smallest = std::min(smallest, inner);
        mass_over_area_ = std::max(mass_over_area_, scene.grains.mass[Grains::at(k)] / (inner * inner));
    }
    target_ = settings.target_overlap * smallest;
    const double fastest = largest_speed(scene);
    if (fastest > 0.0) speed_ = fastest;
    const bool polygons = has_polygons(scene);
    for (MaterialIndex a = 0; a < scene.materials.size(); ++a) {
        for (MaterialIndex b = 0; b < scene.materials.size(); ++b) {
            laws_.push_back(resolve(scene, settings, a, b));
            require(
                !polygons || laws_.back().law.normal == NormalLaw::linear,
                "dem.law: the laws hertz, power and walton-braun are for disks, and this scene has polygons (between "
                "{} and {}): take law = \"linear\", or shapes of type disk",
                scene.materials[a].name, scene.materials[b].name);
        }
    }
    find_longest_step(scene, settings);
}

PairSoftLaw SoftLaws::resolve(const Scene& scene, const DemSettings& settings, MaterialIndex a, MaterialIndex b) const {
    PairSoftLaw pair;
    pair.law = law_of_pair(settings, a, b);
    pair.exponent = exponent_of(pair.law);
    pair.friction = scene.materials.pair(a, b).friction;
    pair.reference = target_;
    if (!(mass_over_area_ > 0.0)) return pair;
    const double exponent = pair.exponent;
    // k such that the fastest impact of a grain of the largest m / R^2 against a wall goes as deep as the target: the
    // whole of m V^2 / 2 in k x^(2 + b) / (2 + b). In the plane the linear k does not depend on the size of grains.
    const double share = settings.target_overlap;
    const double linear = mass_over_area_ * speed_ * speed_ / (share * share);
    pair.stiffness = pair.law.stiffness.value_or(0.5 * (2.0 + exponent) * linear * power(target_, -exponent));
    pair.linear_stiffness = pair.stiffness * power(target_, exponent) * 2.0 / (2.0 + exponent);
    pair.tangential_stiffness = pair.law.tangential_stiffness * pair.linear_stiffness;
    return pair;
}

void SoftLaws::find_longest_step(const Scene& scene, const DemSettings& settings) {
    double stiffest = 0.0;
    double unloading = 1.0;
    for (const PairSoftLaw& pair : laws_) {
        stiffest = std::max(stiffest, pair.linear_stiffness);
        if (pair.law.normal == NormalLaw::walton_braun) unloading = least_restitution(scene);
    }
    const double decay = fastest_decay(scene);
    double shortest_contact = std::numeric_limits<double>::infinity();
    double shortest_decay = std::numeric_limits<double>::infinity();
    const double q = settings.area_exponent;
    for (GrainIndex k = 0; k < scene.grains.size(); ++k) {
        const Shape& shape = scene.shape_of(k);
        double stiffness = stiffest;
        double share = 1.0;
        if (const auto* polygon = std::get_if<PolarPolygon>(&shape)) {
            // W'' for a face of width w, see docs/dem.md, Where polygons touch; at the target area for q < 2, where it
            // falls with depth.
            const double width = flat_width(*polygon) / polygon->inner_radius();
            const double coarse = width / k_coarser_on_faces;
            stiffness = std::max(stiffest, 0.5 * q * (q - 1.0) * stiffest * coarse * coarse);
            // What the dashpot of such a face, gamma W' sqrt(2 m / W), is of one that acts by depth.
            share = std::max(1.0, 0.5 * q * width);
        }
        const double reduced = 0.5 * scene.grains.mass[Grains::at(k)];
        shortest_contact = std::min(shortest_contact, unloading * k_pi * std::sqrt(reduced / stiffness));
        if (decay > 0.0) shortest_decay = std::min(shortest_decay, std::sqrt(reduced) / (decay * share));
    }
    longest_step_ = std::min(shortest_contact / settings.resolution, k_step_over_decay * shortest_decay);
}

/// Fastest decay of the scene's materials, times the square root of the reduced mass [sqrt(kg/m) / s].
double SoftLaws::fastest_decay(const Scene& scene) const {
    DampingRatio ratio;
    double fastest = 0.0;
    std::vector<char> of_grains(materials_, 0);
    for (const MaterialIndex material : scene.grains.material) of_grains[static_cast<std::size_t>(material)] = 1;
    for (MaterialIndex a = 0; a < scene.materials.size(); ++a) {
        if (of_grains[static_cast<std::size_t>(a)] == 0) continue;  // a wall's own restitution decides nothing
        for (MaterialIndex b = 0; b < scene.materials.size(); ++b) {
            const PairSoftLaw& pair = of(a, b);
            if (pair.law.normal == NormalLaw::walton_braun) continue;
            const double gamma = ratio.of(least_restitution(scene, a, b), pair.law.tension);
            fastest = std::max(fastest, decay_over_frequency(gamma) * std::sqrt(pair.linear_stiffness));
        }
    }
    return fastest;
}

double flat_width(const PolarPolygon& polygon) {
    const double depth = 0.02 * polygon.inner_radius();
    double widest = 0.0;
    for (int q = 0; q < polygon.size(); ++q) {
        const Vec2 normal = polygon.normal(q);
        const Vec2 along = left_normal(normal);
        double top = 0.0;
        for (int k = 0; k < polygon.size(); ++k) top = std::max(top, normal.dot(polygon.vertex(k)));
        double low = std::numeric_limits<double>::infinity();
        double high = -low;
        for (int k = 0; k < polygon.size(); ++k) {
            const Vec2 v = polygon.vertex(k);
            if (normal.dot(v) < top - depth) continue;
            low = std::min(low, along.dot(v));
            high = std::max(high, along.dot(v));
        }
        widest = std::max(widest, high - low);
    }
    return widest;
}

double DampingRatio::of(double restitution, bool tension) {
    const double e = std::max(restitution, k_least_restitution);
    if (e == restitution_ && tension == tension_) return ratio_;
    restitution_ = e;
    tension_ = tension;
    ratio_ = tension ? damping_ratio_with_tension(e) : damping_ratio_without_tension(e);
    return ratio_;
}

double damping_of(const PairSoftLaw& pair, double restitution, double mass, bool by_depth, DampingRatio& ratio) {
    const double e = std::max(restitution, k_least_restitution);
    if (by_depth && pair.law.normal == NormalLaw::walton_braun) return pair.stiffness / (e * e);
    const double gamma = ratio.of(restitution, pair.law.tension);
    if (!by_depth) return gamma;
    const double b = pair.exponent;
    return damping_constant(gamma, mass, pair.stiffness, b, pair.law.damping_exponent.value_or(0.5 * b),
                            pair.reference);
}

namespace {

/// Elastic force and dashpot constant; fills in what the law keeps.
double normal_response(const PairSoftLaw& pair, const Touch& touch, double mass, SoftContact& c) {
    if (!touch.by_depth) {
        c.elastic_normal = touch.force;
        c.stored_normal = touch.energy;
        return proportional_damping({touch.force, touch.energy}, c.damping, mass);
    }
    switch (pair.law.normal) {
        case NormalLaw::linear: {
            const Elastic elastic = linear_spring(touch.depth, pair.stiffness);
            c.elastic_normal = elastic.force;
            c.stored_normal = elastic.energy;
            return c.damping;
        }
        case NormalLaw::walton_braun: {
            const Hysteretic h = walton_braun_spring(touch.depth, c.largest, pair.stiffness, c.damping);
            c.elastic_normal = h.force;
            c.stored_normal = h.energy;
            c.hysteresis = h.lost - walton_braun_loss(c.largest, pair.stiffness, c.damping);
            c.largest = h.largest;
            return 0.0;
        }
        case NormalLaw::hertz:
        case NormalLaw::power: {
            const double b = pair.exponent;
            const Elastic elastic =
                b == 0.5 ? hertz_spring(touch.depth, pair.stiffness) : power_spring(touch.depth, pair.stiffness, b);
            c.elastic_normal = elastic.force;
            c.stored_normal = elastic.energy;
            const double g = pair.law.damping_exponent.value_or(0.5 * b);
            if (g == 0.25) return c.damping * std::sqrt(std::sqrt(touch.depth));
            if (g == 0.5) return c.damping * std::sqrt(touch.depth);
            return g == 0.0 ? c.damping : c.damping * power(touch.depth, g);
        }
    }
    return 0.0;
}

}  // namespace

void respond(const PairSoftLaw& pair, const Touch& touch, double mass, const TouchRate& rate, double way,
             SoftContact& c) {
    const double pressed = std::max(0.0, c.normal_force);
    const double damping = normal_response(pair, touch, mass, c);
    if (touch.width > 0.0) {
        const FaceForce face =
            damped_face(c.elastic_normal, damping, rate.closing, rate.spin, touch.width, pair.law.tension);
        c.normal_force = face.force;
        c.moment = face.moment;
    } else {
        c.normal_force = damped_force(c.elastic_normal, damping, rate.closing, pair.law.tension);
    }
    const double push = std::max(0.0, c.normal_force);
    const double limit = pair.friction * push;
    Tangential tangential;
    switch (pair.law.tangential) {
        case TangentialLaw::spring:
            tangential = spring_slider(c.stretch + way, pair.tangential_stiffness,
                                       pair.law.tangential_damping * damping, rate.sliding, limit);
            break;
        case TangentialLaw::slider:
            tangential = viscous_slider(pair.law.tangential_damping * damping, rate.sliding, limit);
            break;
        case TangentialLaw::walton_braun: {
            const IncrementalMemory memory = walton_braun_tangential({c.stretch, c.turning, pressed}, way,
                                                                     pair.tangential_stiffness, push, pair.friction);
            c.turning = memory.turning;
            tangential = {-memory.force, memory.force, 0.0};
            break;
        }
    }
    c.sliding_force = tangential.force;
    c.stretch = tangential.stretch;
    c.stored_sliding = tangential.energy;
}

}  // namespace polargrain
