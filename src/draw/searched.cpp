#include "draw/searched.h"

#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>

#include "results/parts.h"

namespace palpation::draw {

void add_beyond_search(Outcome& outcome) {
  std::vector<Vec3> readings;
  for (const Touch& touch : outcome.touches)
    if (!touch.set_aside && !touch.planned) readings.push_back(touch.position);
  Points places(outcome.surface->GetNumberOfPoints(), 3);
  Vec3 place;
  for (vtkIdType i = 0; i < places.rows(); ++i) {
    outcome.surface->GetPoint(i, place.data());
    places.row(i) = place;
  }
  vtkNew<vtkDoubleArray> beyond;
  beyond->SetName(kBeyondSearch);
  for (const double value : results::beyond_search(places, readings))
    beyond->InsertNextValue(value);
  outcome.surface->GetPointData()->AddArray(beyond);
}

bool Outcome::is_searched() const {
  vtkDataArray* beyond = field(kBeyondSearch);
  return beyond == nullptr || beyond->GetRange()[1] < 0.0;
}

}  // namespace palpation::draw
