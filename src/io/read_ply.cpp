#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "io/ply_body.h"
#include "io/ply_header.h"
#include "io/polygon_soup.h"
#include "palpation/base/error.h"

namespace palpation {
namespace {

constexpr int kHeightSd = 3;  // behind x, y and z

template <typename Body>
class BodyReader {
 public:
  BodyReader(const MeshSource& source, const PlyHeader& header)
      : source_(source), header_(header), body_(source, header) {
    soup_.place_kind = Body::kPlaceKind;
  }

  PolygonSoup read() {
    for (const PlyElement& element : header_.elements) {
      check_count(element);
      if (element.name == "vertex") {
        read_vertices(element);
      } else if (element.name == "face") {
        read_faces(element);
      } else {
        skip_element(element);
      }
    }
    body_.expect_end();
    soup_.warn_of_underflows(body_.warned_underflows());
    return std::move(soup_);
  }

 private:
  /// Before anything is allocated: as many records as announced must fit into the bytes that are
  /// left.
  void check_count(const PlyElement& element) const {
    std::int64_t least = 0;
    for (const PlyProperty& property : element.properties)
      least += Body::least_size(property.count_type.value_or(property.type));
    const bool fits = least == 0 || element.count <= body_.bytes_left() / least;
    if (fits && element.count <= std::numeric_limits<int>::max()) return;
    source_.fail_at_line(element.line, std::to_string(element.count) + " of element " +
                                           in_quotes(element.name) + " do not fit into the " +
                                           std::to_string(body_.bytes_left()) + " bytes left");
  }

  void read_vertices(const PlyElement& element) {
    // Which property is x, y, z or height_sd, and -1 for the others.
    std::vector<int> component(element.properties.size(), -1);
    for (int axis = 0; axis < 3; ++axis) {
      const std::string name(1, "xyz"[axis]);
      const auto found = std::find_if(element.properties.begin(), element.properties.end(),
                                      [&](const PlyProperty& p) { return p.name == name; });
      if (found == element.properties.end() || found->count_type) {
        source_.fail_at_line(element.line, "element \"vertex\" has no number \"" + name + "\"");
      }
      component[found - element.properties.begin()] = axis;
    }
    for (std::size_t i = 0; i < component.size(); ++i) {
      const PlyProperty& property = element.properties[i];
      if (property.name == "height_sd" && !property.count_type) component[i] = kHeightSd;
    }
    soup_.points.reserve(element.count);
    for (std::int64_t vertex = 0; vertex < element.count; ++vertex)
      read_vertex(element, component, vertex);
  }

  void read_vertex(const PlyElement& element, const std::vector<int>& component,
                   std::int64_t vertex) {
    body_.begin_record();
    Vec3 point = Vec3::Zero();
    for (std::size_t i = 0; i < component.size(); ++i) {
      const PlyProperty& property = element.properties[i];
      if (component[i] < 0) {
        skip_property(property);
        continue;
      }
      const double value = body_.real(property.type, property.name);
      if (!std::isfinite(value))
        body_.fail("vertex " + std::to_string(vertex) + ": " + property.name + " = " +
                   text_of(value) + " is not finite");
      if (component[i] == kHeightSd) {
        take_height_sd(value, vertex);
      } else {
        point[component[i]] = value;
      }
    }
    soup_.points.push_back(point);
  }

  void take_height_sd(double value, std::int64_t vertex) {
    if (value < 0.0)
      body_.fail("vertex " + std::to_string(vertex) + ": height_sd = " + text_of(value) +
                 " is a standard deviation, and must not be negative");
    soup_.height_sd.push_back(value);
  }

  void read_faces(const PlyElement& element) {
    const auto is_corner_list = [](const PlyProperty& p) {
      return p.name == "vertex_indices" || p.name == "vertex_index";
    };
    const auto found =
        std::find_if(element.properties.begin(), element.properties.end(), is_corner_list);
    if (found == element.properties.end() || !found->count_type || is_real(found->type)) {
      source_.fail_at_line(element.line,
                           "element \"face\" has no list of whole numbers \"vertex_indices\"");
    }
    if (std::count_if(element.properties.begin(), element.properties.end(), is_corner_list) > 1)
      source_.fail_at_line(element.line,
                           "element \"face\" has both \"vertex_indices\" and \"vertex_index\"");
    for (std::int64_t face = 0; face < element.count; ++face) {
      body_.begin_record();
      for (const PlyProperty& property : element.properties) {
        if (&property == &*found) {
          read_corners(property);
        } else {
          skip_property(property);
        }
      }
    }
  }

  void read_corners(const PlyProperty& property) {
    const std::int64_t start = body_.place();
    const std::int64_t count = list_length(property);
    // Words know their line once they are read.
    soup_.begin_face(Body::kPlaceKind == PlaceKind::Byte ? start : body_.place());
    for (std::int64_t i = 0; i < count; ++i) {
      const std::int64_t index = body_.integer(property.type, "a vertex index");
      if (index < 0 || index > std::numeric_limits<int>::max()) {
        body_.fail("face " + std::to_string(soup_.face_count() - 1) + ": vertex index " +
                   std::to_string(index) + " is out of range 0 to " +
                   std::to_string(static_cast<std::int64_t>(soup_.points.size()) - 1));
      }
      soup_.corners.push_back(static_cast<int>(index));
    }
    soup_.end_face(source_);
  }

  std::int64_t list_length(const PlyProperty& property) {
    const std::int64_t count = body_.integer(*property.count_type, "the length of a list");
    if (count < 0 || count > body_.bytes_left() / Body::least_size(property.type)) {
      body_.fail("a list " + in_quotes(property.name) + " of " + std::to_string(count) +
                 " numbers does not fit into the " + std::to_string(body_.bytes_left()) +
                 " bytes left");
    }
    return count;
  }

  void skip_property(const PlyProperty& property) {
    const std::int64_t count = property.count_type ? list_length(property) : 1;
    for (std::int64_t i = 0; i < count; ++i) body_.skip(property.type, property.name);
  }

  void skip_element(const PlyElement& element) {
    if (element.properties.empty()) return;
    for (std::int64_t i = 0; i < element.count; ++i) {
      body_.begin_record();
      for (const PlyProperty& property : element.properties) skip_property(property);
    }
  }

  const MeshSource& source_;
  const PlyHeader& header_;
  Body body_;
  PolygonSoup soup_;
};

}  // namespace

PolygonSoup read_ply(const MeshSource& source) {
  const PlyHeader header = read_ply_header(source);
  if (header.encoding != PlyEncoding::Ascii) {
    PolygonSoup soup = BodyReader<PlyBinaryBody>(source, header).read();
    soup.format = header.encoding == PlyEncoding::Big ? "binary PLY, big-endian" : "binary PLY";
    return soup;
  }
  PolygonSoup soup = BodyReader<PlyAsciiBody>(source, header).read();
  soup.format = "ASCII PLY";
  return soup;
}

}  // namespace palpation
