#include "python/places_on.h"

#include <optional>
#include <string>

#include "geometry/settled_point.h"
#include "io/landing.h"
#include "palpation/base/error.h"
#include "python/long_call.h"

namespace py = pybind11;

namespace palpation::python {
namespace {

std::vector<SurfacePoint> vertices_on(const Surface& surface, const std::vector<int>& vertices) {
  std::vector<SurfacePoint> places;
  places.reserve(vertices.size());
  for (const int vertex : vertices) places.push_back(surface.at_vertex(vertex));
  return places;
}

}  // namespace

std::vector<SurfacePoint> places_on(const Surface& surface, py::handle where,
                                    const Argument& argument) {
  if (is_list_of_integers(where))
    return vertices_on(surface, indices_of(where, argument, surface.vertex_count()));
  const Points positions = points_of(where, argument);
  return long_call([&] {
    Landing landing(surface);
    std::vector<SurfacePoint> places;
    for (Eigen::Index row = 0; row < positions.rows(); ++row) {
      std::string fault;
      const std::optional<SurfacePoint> place =
          landing.place(positions.row(row).transpose(), fault);
      if (!place)
        throw InvalidInput(std::string(argument.function) + ": " + argument.name + ": row " +
                           std::to_string(row) + ": " + fault +
                           " (positions are metres in the mesh's frame)");
      places.push_back(settled_point(surface, *place));
    }
    return places;
  });
}

}  // namespace palpation::python
