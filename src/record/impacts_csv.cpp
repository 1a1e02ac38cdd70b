#include "src/record/impacts_csv.h"

#include <fmt/format.h>

#include <iterator>

namespace polargrain {

namespace {

constexpr const char* k_columns =
    "time,step,i,j,px,py,nx,ny,x_i,y_i,x_j,y_j,e,mu,mode,impulse_n,impulse_t,closing_before,closing_after,"
    "sliding_before,sliding_after,vx_i,vy_i,w_i,vx_j,vy_j,w_j,vx_i_after,vy_i_after,w_i_after,vx_j_after,vy_j_after,"
    "w_j_after\n";

void append(std::string& row, double value) { fmt::format_to(std::back_inserter(row), ",{:.17g}", value); }

void append(std::string& row, const Vec2& value) {
    append(row, value.x());
    append(row, value.y());
}

void append(std::string& row, const Motion& motion) {
    append(row, motion.velocity);
    append(row, motion.spin);
}

std::string body_name(BodyIndex body, const std::vector<std::string>& wall_names) {
    return is_wall(body) ? wall_names[static_cast<std::size_t>(wall_index(body))] : fmt::format("{}", body);
}

void append_row(std::string& text, const ImpactRecord& impact, const std::vector<std::string>& wall_names) {
    fmt::format_to(std::back_inserter(text), "{:.17g},{},{},{}", impact.time, impact.step,
                   body_name(impact.i, wall_names), body_name(impact.j, wall_names));
    for (const Vec2& v : {impact.point, impact.normal, impact.centre_i, impact.centre_j}) append(text, v);
    append(text, impact.restitution);
    append(text, impact.friction);
    fmt::format_to(std::back_inserter(text), ",{}", to_string(impact.mode));
    for (const double value : {impact.impulse_normal, impact.impulse_tangential, impact.closing_before,
                               impact.closing_after, impact.sliding_before, impact.sliding_after}) {
        append(text, value);
    }
    for (const Motion& motion : {impact.i_before, impact.j_before, impact.i_after, impact.j_after}) {
        append(text, motion);
    }
    text += '\n';
}

}  // namespace

ImpactsCsv::ImpactsCsv(std::filesystem::path path, double every) : path_(std::move(path)), every_(every) {}

void ImpactsCsv::name_walls(const Scene& scene) {
    wall_names_.clear();
    for (const Wall& wall : scene.walls) wall_names_.push_back(csv_field(wall.name));
}

void ImpactsCsv::begin(const Scene& scene, const RunInfo& /*info*/) {
    name_walls(scene);
    file_.emplace(path_);
    file_->write(k_columns);
    file_->flush();
}

void ImpactsCsv::save(Checkpoint& checkpoint) { file_->save(checkpoint); }

void ImpactsCsv::check(const Scene& /*scene*/, const Checkpoint& saved) const { TextFile::check(path_, saved); }

void ImpactsCsv::resume(const Scene& scene, const RunInfo& /*info*/, const Checkpoint& saved) {
    name_walls(scene);
    file_.emplace(path_, saved);
}

void ImpactsCsv::step(const World& /*world*/, double /*dt*/, const StepReport& report) {
    text_.clear();
    for (const ImpactRecord& impact : report.impact_records) append_row(text_, impact, wall_names_);
    file_->write(text_);
}

void ImpactsCsv::sample(const Sample& /*sample*/) { file_->flush(); }

void ImpactsCsv::end() {
    file_->sync();
    file_->close();
}

}  // namespace polargrain
