#include "src/export/vtp.h"

#include <fmt/format.h>

#include <bit>
#include <cstring>
#include <iterator>

namespace polargrain {

namespace {

constexpr const char* k_byte_order = std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian";

const char* type_name(std::int32_t /*number*/) { return "Int32"; }
const char* type_name(double /*number*/) { return "Float64"; }

/// The XML head, and the bytes that it points to.
class VtpText {
public:
    explicit VtpText(double time) {
        head_ = fmt::format(
            "<?xml version=\"1.0\"?>\n"
            "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"{}\" header_type=\"UInt64\">\n"
            "<PolyData>\n"
            "<FieldData>\n"
            "<DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">{}</DataArray>\n"
            "</FieldData>\n",
            k_byte_order, time);
    }

    void open(const std::string& element) { head_ += "<" + element + ">\n"; }
    void close(const std::string& element) { head_ += "</" + element + ">\n"; }

    void put(const NamedNumbers& numbers) {
        std::visit([&](const auto& values) { put(numbers.name, values, numbers.components); }, numbers.values);
    }
    void put(const char* element, const std::vector<NamedNumbers>& arrays) {
        open(element);
        for (const NamedNumbers& numbers : arrays) put(numbers);
        close(element);
    }
    void put(const char* element, const CellList& cells) {
        open(element);
        put("connectivity", cells.corners, 1);
        put("offsets", cells.ends, 1);
        close(element);
    }
    std::string whole() && {
        close("PolyData");
        return std::move(head_) + "<AppendedData encoding=\"raw\">\n_" + bytes_ + "\n</AppendedData>\n</VTKFile>\n";
    }

private:
    template <typename T>
    void put(const std::string& name, const std::vector<T>& values, int components) {
        fmt::format_to(
            std::back_inserter(head_),
            "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"appended\" offset=\"{}\"/>\n",
            type_name(T{}), name, components, bytes_.size());
        append<std::uint64_t>({{values.size() * sizeof(T)}});
        append<T>(values);
    }
    template <typename T>
    void append(std::span<const T> values) {
        const std::size_t from = bytes_.size();
        bytes_.resize(from + values.size_bytes());
        if (!values.empty()) std::memcpy(bytes_.data() + from, values.data(), values.size_bytes());
    }

    std::string head_;
    std::string bytes_;  // of each array its length in bytes, then the array
};

}  // namespace

std::string vtp_text(const PolyData& data, double time) {
    VtpText text(time);
    text.open(
        fmt::format("Piece NumberOfPoints=\"{}\" NumberOfVerts=\"{}\" NumberOfLines=\"{}\" NumberOfStrips=\"0\" "
                    "NumberOfPolys=\"{}\"",
                    data.points.size(), data.verts.size(), data.lines.size(), data.polys.size()));
    text.put("PointData", data.point_data);
    text.put("CellData", data.cell_data);
    text.put("Points", {in_space("Points", data.points)});
    text.put("Verts", data.verts);
    text.put("Lines", data.lines);
    text.put("Polys", data.polys);
    text.close("Piece");
    return std::move(text).whole();
}

std::string pvd_text(std::span<const TimedFile> files) {
    std::string text = fmt::format(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"{}\">\n<Collection>\n",
        k_byte_order);
    for (const TimedFile& entry : files) {
        fmt::format_to(std::back_inserter(text), "<DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", entry.time,
                       entry.file);
    }
    return text + "</Collection>\n</VTKFile>\n";
}

}  // namespace polargrain
