#include "src/detect/outline_meeting.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "src/detect/edge_gaps.h"

namespace polargrain {

namespace {

constexpr int k_secants = 5;  // to round-off on the ways of a step

/// A grain and where it flies, with its poses at the ends of the time that is looked at.
struct Flyer {
    const PolarPolygon& outline;
    const Flight& flight;
    Pose first{}, last{};
};

struct Times {
    double first, last;
};

/// The vertices of one grain on their way over the edges of another, in the frame of the other.
class Passage {
public:
    Passage(const Flyer& own, const Flyer& other, const Times& times, double touching, bool on_i)
        : own_(own), other_(other), times_(times), touching_(touching), on_i_(on_i) {}

    /// Puts into `found` what is earlier.
    void look(std::optional<OutlineMeeting>& found) const {
        const Pose first = own_.first.relative_to(other_.first);
        const Pose last = own_.last.relative_to(other_.last);
        const Vec2 turn(last.cosine - first.cosine, last.sine - first.sine);
        const double way = std::sqrt((last.centre - first.centre).squaredNorm()) +
                           std::sqrt(turn.squaredNorm()) * own_.outline.outer_radius();
        const double reach = other_.outline.outer_radius() + touching_ + way;
        const Vec2 centre = first.to_local(Vec2::Zero());
        for (int k = 0; k < own_.outline.size(); ++k) {
            const Vec2 p = own_.outline.vertex(k);
            if ((p - centre).squaredNorm() <= reach * reach) follow(k, first.to_world(p), last.to_world(p), found);
        }
    }

private:
    double gap(const Vec2& p, int edge) const { return gap_to_edge(other_.outline, edge, p) - touching_; }

    /// Through the sectors from p to q, the shorter way round.
    void follow(int vertex, const Vec2& p, const Vec2& q, std::optional<OutlineMeeting>& found) const {
        const PolarPolygon& over = other_.outline;
        const int last = over.sector_of(q);
        int edge = over.sector_of(p);
        const int ahead = last >= edge ? last - edge : last - edge + over.size();
        const bool forwards = 2 * ahead <= over.size();
        look_at(vertex, edge, p, q, true, found);
        while (edge != last) {
            edge = forwards ? over.next(edge) : over.previous(edge);
            look_at(vertex, edge, p, q, false, found);
        }
    }

    /// Does the vertex come to the edge between p and q? Being too near from the beginning counts for the edge in whose
    /// sector it is.
    void look_at(int vertex, int edge, const Vec2& p, const Vec2& q, bool from_there,
                 std::optional<OutlineMeeting>& found) const {
        const double before = gap(p, edge);
        const double after = gap(q, edge);
        if (after >= 0.0 || after >= before || (before <= 0.0 && !from_there)) return;
        const double time = before > 0.0 ? crossing(vertex, edge, before, after) : times_.first;
        if (found && found->time <= time) return;
        if (is_contact(vertex, edge, seen(time))) found = OutlineMeeting{time, vertex, edge, on_i_};
    }

    /// By secants, as the way is not quite straight.
    double crossing(int vertex, int edge, double before, double after) const {
        double time = times_.last;
        double here = after;
        double last_time = times_.first;
        double last = before;
        for (int n = 0; n < k_secants && here != last; ++n) {
            const double next = std::clamp(time + (time - last_time) * here / (last - here), times_.first, times_.last);
            last_time = std::exchange(time, next);
            last = std::exchange(here, gap(seen(next).to_world(own_.outline.vertex(vertex)), edge));
        }
        return time;
    }

    /// Is the vertex over the edge, and its own grain in front of it? Where two corners meet, it is so for one of them.
    bool is_contact(int vertex, int edge, const Pose& pose) const {
        const PolarPolygon& own = own_.outline;
        const PolarPolygon& over = other_.outline;
        const Vec2 p = own.vertex(vertex);
        const Vec2 start = over.vertex(edge);
        const Vec2 along = over.vertex(over.next(edge)) - start;
        if (!is_over_edge(start, along, pose.to_world(p), touching_)) return false;
        return !neighbour_behind({pose.to_world(p), pose.turned(own.vertex(own.previous(vertex)) - p),
                                  pose.turned(own.vertex(own.next(vertex)) - p)},
                                 over.normal(edge), 0.0);
    }

    Pose seen(double time) const { return own_.flight.at(time).relative_to(other_.flight.at(time)); }

    const Flyer& own_;
    const Flyer& other_;
    Times times_;
    double touching_;
    bool on_i_;
};

}  // namespace

std::optional<OutlineMeeting> first_meeting(const PolarPolygon& i, const Flight& of_i, const PolarPolygon& j,
                                            const Flight& of_j, double touching, double from, double to) {
    const double turn = (to - from) * std::max(std::abs(of_i.spin), std::abs(of_j.spin));
    const int pieces = 1 + static_cast<int>(turn / k_meeting_turn);
    Flyer flyer_i{i, of_i, {}, of_i.at(from)};
    Flyer flyer_j{j, of_j, {}, of_j.at(from)};
    std::optional<OutlineMeeting> found;
    double begin = from;
    for (int n = 1; n <= pieces && !found; ++n) {
        const double end = from + (to - from) * n / pieces;
        for (Flyer* flyer : {&flyer_i, &flyer_j}) {
            flyer->first = flyer->last;
            flyer->last = flyer->flight.at(end);
        }
        Passage(flyer_i, flyer_j, {begin, end}, touching, true).look(found);
        Passage(flyer_j, flyer_i, {begin, end}, touching, false).look(found);
        begin = end;
    }
    return found;
}

}  // namespace polargrain
