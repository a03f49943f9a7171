#include "draw/tissue_view.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkClipPolyData.h>
#include <vtkDoubleArray.h>
#include <vtkLookupTable.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataNormals.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace palpation::draw {
namespace {

constexpr double kMarginShare = 0.008;  // of the longer visible side
constexpr double kLayerStep_px = 2.5;   // towards the viewer, from one layer of ink to the next
constexpr double kFlatnessTolerance = 1e-6;  // of the diameter
constexpr double kAlikeCosine = 0.985;       // 10 degrees

Vec3 point_of(vtkPolyData& mesh, vtkIdType point) {
  Vec3 position;
  mesh.GetPoint(point, position.data());
  return position;
}

struct Corner {
  vtkIdType a, b, c;
};

std::vector<Corner> triangles_of(vtkPolyData& mesh) {
  std::vector<Corner> triangles;
  triangles.reserve(static_cast<std::size_t>(mesh.GetNumberOfPolys()));
  vtkIdType size = 0;
  const vtkIdType* corners = nullptr;
  for (vtkIdType cell = 0; cell < mesh.GetNumberOfPolys(); ++cell) {
    mesh.GetPolys()->GetCellAtId(cell, size, corners);
    triangles.push_back({corners[0], corners[1], corners[2]});
  }
  return triangles;
}

// Twice the area of a triangle times its outward normal.
Vec3 area_vector(vtkPolyData& mesh, const Corner& corner) {
  const Vec3 a = point_of(mesh, corner.a);
  return (point_of(mesh, corner.b) - a).cross(point_of(mesh, corner.c) - a);
}

struct Facing {
  Vec3 sum = Vec3::Zero();
  double total = 0.0;
  bool is_clear() const { return total > 0.0 && sum.norm() > 0.05 * total; }
};

Facing facing_of_tissue(vtkPolyData& mesh, vtkDataArray* field, double level) {
  Facing facing;
  for (const Corner& corner : triangles_of(mesh)) {
    const bool inside = field == nullptr || (field->GetComponent(corner.a, 0) >= level &&
                                             field->GetComponent(corner.b, 0) >= level &&
                                             field->GetComponent(corner.c, 0) >= level);
    if (!inside) continue;
    const Vec3 area = area_vector(mesh, corner);
    facing.sum += area;
    facing.total += area.norm();
  }
  return facing;
}

Vec3 direction_to_viewer(const Outcome& outcome, std::optional<double> level) {
  vtkDataArray* mean = outcome.field("mean");
  const Facing whole = facing_of_tissue(*outcome.surface, nullptr, 0.0);
  const bool planar = whole.total > 0.0 && whole.sum.norm() > (1.0 - 1e-9) * whole.total;
  if (!planar && mean != nullptr && level) {
    const Facing tumour = facing_of_tissue(*outcome.surface, mean, *level);
    if (tumour.is_clear()) return tumour.sum.normalized();
  }
  if (whole.is_clear()) return whole.sum.normalized();
  return Vec3::UnitZ();
}

Eigen::Matrix3d frame_facing(const Vec3& towards_viewer) {
  const Vec3 axis = std::abs(towards_viewer.x()) > kAlikeCosine ? Vec3::UnitY() : Vec3::UnitX();
  const Vec3 right = (axis - towards_viewer * towards_viewer.dot(axis)).normalized();
  Eigen::Matrix3d turn;
  turn << right.transpose(), towards_viewer.cross(right).transpose(), towards_viewer.transpose();
  return turn;
}

Vec3 vertex_nearest_to_centroid(vtkPolyData& mesh) {
  Vec3 sum = Vec3::Zero();
  double total = 0.0;
  for (const Corner& corner : triangles_of(mesh)) {
    const double area = area_vector(mesh, corner).norm();
    sum += area * (point_of(mesh, corner.a) + point_of(mesh, corner.b) + point_of(mesh, corner.c)) /
           3.0;
    total += area;
  }
  Vec3 nearest = Vec3::Zero();
  double least = std::numeric_limits<double>::infinity();
  for (vtkIdType i = 0; i < mesh.GetNumberOfPoints(); ++i) {
    const double distance = (point_of(mesh, i) - sum / total).norm();
    if (distance >= least) continue;
    least = distance;
    nearest = point_of(mesh, i);
  }
  return nearest;
}

vtkSmartPointer<vtkPolyData> turned(vtkPolyData& mesh, const View& view) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(mesh.GetNumberOfPoints());
  for (vtkIdType i = 0; i < mesh.GetNumberOfPoints(); ++i)
    points->SetPoint(i, view.to_view_mm(point_of(mesh, i)).data());
  auto result = vtkSmartPointer<vtkPolyData>::New();
  result->SetPoints(points);
  result->SetPolys(mesh.GetPolys());
  return result;
}

vtkSmartPointer<vtkPolyData> with_normals(vtkPolyData& mesh) {
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputData(&mesh);
  normals->SplittingOff();
  normals->ConsistencyOff();
  normals->Update();
  return normals->GetOutput();
}

void add_field(vtkPolyData& mesh, const char* name, vtkDataArray& field, double minus) {
  vtkNew<vtkDoubleArray> values;
  values->SetName(name);
  values->SetNumberOfTuples(field.GetNumberOfTuples());
  for (vtkIdType i = 0; i < field.GetNumberOfTuples(); ++i)
    values->SetValue(i, field.GetComponent(i, 0) - minus);
  mesh.GetPointData()->AddArray(values);
}

// Sides that belong to one triangle only. VTK's filter for this asks for more memory than there is
// on a mesh of a million vertices.
std::vector<std::array<vtkIdType, 2>> rim_of(vtkPolyData& mesh) {
  std::vector<std::array<vtkIdType, 2>> sides;
  sides.reserve(static_cast<std::size_t>(mesh.GetNumberOfPolys()) * 3);
  for (const auto& [a, b, c] : triangles_of(mesh)) {
    for (const auto& [from, to] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)})
      sides.push_back({std::min(from, to), std::max(from, to)});
  }
  std::sort(sides.begin(), sides.end());
  std::vector<std::array<vtkIdType, 2>> rim;
  for (std::size_t i = 0; i < sides.size();) {
    std::size_t next = i + 1;
    while (next < sides.size() && sides[next] == sides[i]) ++next;
    if (next == i + 1) rim.push_back(sides[i]);
    i = next;
  }
  return rim;
}

struct Halves {
  vtkSmartPointer<vtkPolyData> above, below;
};

Halves cut_at_zero(vtkPolyData& mesh, const char* field) {
  mesh.GetPointData()->SetActiveScalars(field);
  vtkNew<vtkClipPolyData> clip;
  clip->SetInputData(&mesh);
  clip->SetValue(0.0);
  clip->GenerateClippedOutputOn();
  clip->Update();
  return {clip->GetOutput(), clip->GetClippedOutput()};
}

// Shading that shows the shape of curved tissue and leaves the colours of a map alone.
void set_light(vtkProperty& property, bool lit) {
  property.SetLighting(lit);
  property.SetAmbient(lit ? 0.58 : 1.0);
  property.SetDiffuse(lit ? 0.44 : 0.0);
  property.SetSpecular(0.0);
  property.SetInterpolationToPhong();
}

void set_colour(vtkProperty& property, Colour colour) {
  property.SetColor(colour.red / 255.0, colour.green / 255.0, colour.blue / 255.0);
}

// Polygons that face the viewer.
class Shapes {
 public:
  Shapes() { points_->SetDataTypeToDouble(); }

  void disc(const Vec3& centre, double radius) {
    for (const Pixel& corner : circle(centre.head<2>(), radius))
      corners_.push_back(points_->InsertNextPoint(corner.x(), corner.y(), centre.z()));
    close();
  }

  void strip(const Vec3& from, const Vec3& to, double width) {
    const Vec3 along = to - from;
    const Vec3 across = Vec3(-along.y(), along.x(), 0.0);
    if (across.norm() == 0.0) return;
    const Vec3 half = across.normalized() * (width / 2.0);
    for (const Vec3& corner :
         {Vec3(from - half), Vec3(to - half), Vec3(to + half), Vec3(from + half)}) {
      corners_.push_back(points_->InsertNextPoint(corner.data()));
    }
    close();
  }

  void line(const std::vector<Vec3>& points, double width) {
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      strip(points[i], points[i + 1], width);
      if (i > 0) disc(points[i], width / 2.0);
    }
    const bool closed = points.size() > 2 && points.front() == points.back();
    if (closed) disc(points.front(), width / 2.0);
  }

  vtkSmartPointer<vtkPolyData> polygons() const {
    auto result = vtkSmartPointer<vtkPolyData>::New();
    result->SetPoints(points_);
    result->SetPolys(cells_);
    return result;
  }

 private:
  void close() {
    cells_->InsertNextCell(static_cast<vtkIdType>(corners_.size()), corners_.data());
    corners_.clear();
  }

  vtkNew<vtkPoints> points_;
  vtkNew<vtkCellArray> cells_;
  std::vector<vtkIdType> corners_;
};

}  // namespace

View view_of(const Outcome& outcome, std::optional<double> level) {
  View view;
  view.in_chart = outcome.unrolled;
  const Vec3 towards_viewer = direction_to_viewer(outcome, level);
  view.turn = frame_facing(towards_viewer);
  if (towards_viewer.z() < 1.0 - 1e-12) view.origin = vertex_nearest_to_centroid(*outcome.surface);
  Vec3 lowest = Vec3::Constant(std::numeric_limits<double>::infinity());
  Vec3 highest = -lowest;
  for (vtkIdType i = 0; i < outcome.surface->GetNumberOfPoints(); ++i) {
    const Vec3 place = view.to_view_mm(point_of(*outcome.surface, i));
    lowest = lowest.cwiseMin(place);
    highest = highest.cwiseMax(place);
  }
  const Vec3 size = highest - lowest;
  view.flat = size.z() <= kFlatnessTolerance * size.norm();
  const double margin = kMarginShare * std::max(size.x(), size.y());
  view.left_mm = lowest.x() - margin;
  view.bottom_mm = lowest.y() - margin;
  view.width_mm = size.x() + 2.0 * margin;
  view.height_mm = size.y() + 2.0 * margin;
  view.back_mm = lowest.z();
  view.front_mm = highest.z();
  for (const auto& [from, to] : rim_of(*outcome.surface)) {
    view.rim_mm.push_back({view.to_view_mm(point_of(*outcome.surface, from)),
                           view.to_view_mm(point_of(*outcome.surface, to))});
  }
  return view;
}

View zoomed_to(const View& whole, const Outcome& outcome, const std::vector<std::string>& kinds) {
  constexpr double kRoom = 1.3, kLeastRoom_mm = 4.0;
  Vec3 lowest = Vec3::Constant(std::numeric_limits<double>::infinity());
  Vec3 highest = -lowest;
  for (const Curve& curve : outcome.curves) {
    if (std::find(kinds.begin(), kinds.end(), curve.kind) == kinds.end()) continue;
    for (const Vec3& point : curve.points) {
      lowest = lowest.cwiseMin(whole.to_view_mm(point));
      highest = highest.cwiseMax(whole.to_view_mm(point));
    }
  }
  if (!whole.flat || !(lowest.x() <= highest.x())) return whole;
  const auto window = [](double low, double high, double& from, double& length) {
    const double wanted = std::min(length, kRoom * (high - low) + kLeastRoom_mm);
    from = std::clamp(0.5 * (low + high - wanted), from, from + length - wanted);
    length = wanted;
  };
  View part = whole;
  window(lowest.x(), highest.x(), part.left_mm, part.width_mm);
  window(lowest.y(), highest.y(), part.bottom_mm, part.height_mm);
  return part;
}

TissueScene::TissueScene(vtkRenderer& renderer, const View& view, const Box& box)
    : renderer_(renderer), view_(view), mm_per_px_(view.width_mm / box.width) {}

void TissueScene::paint_field(const Outcome& outcome, vtkDataArray& field,
                              const ColourScale& scale) {
  vtkSmartPointer<vtkPolyData> mesh = turned(*outcome.surface, view_);
  if (!view_.flat) mesh = with_normals(*mesh);
  add_field(*mesh, "field", field, 0.0);
  mesh->GetPointData()->SetActiveScalars("field");
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(mesh);
  mapper->SetLookupTable(scale.table());
  mapper->UseLookupTableScalarRangeOn();
  mapper->InterpolateScalarsBeforeMappingOn();
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  set_light(*actor->GetProperty(), !view_.flat);
  renderer_.AddActor(actor);
}

void TissueScene::paint(vtkPolyData& part, Colour colour) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(&part);
  mapper->ScalarVisibilityOff();
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  set_colour(*actor->GetProperty(), colour);
  set_light(*actor->GetProperty(), !view_.flat);
  renderer_.AddActor(actor);
}

void TissueScene::paint_margins(const Outcome& outcome, double estimate_level, double truth_level) {
  vtkSmartPointer<vtkPolyData> mesh = turned(*outcome.surface, view_);
  if (!view_.flat) mesh = with_normals(*mesh);
  add_field(*mesh, "estimate", *outcome.field("mean"), estimate_level);
  add_field(*mesh, "truth", *outcome.field("truth"), truth_level);
  const Halves estimate = cut_at_zero(*mesh, "estimate");
  const Halves found = cut_at_zero(*estimate.above, "truth");
  const Halves left = cut_at_zero(*estimate.below, "truth");
  paint(*found.above, kAgreement);
  paint(*found.below, kExtra);
  paint(*left.above, kMissed);
  paint(*left.below, kHealthy);
}

void TissueScene::paint_zones(const Outcome& outcome, double band_score) {
  vtkSmartPointer<vtkPolyData> mesh = turned(*outcome.surface, view_);
  if (!view_.flat) mesh = with_normals(*mesh);
  add_field(*mesh, "inner", *outcome.field("score"), band_score);
  add_field(*mesh, "outer", *outcome.field("score"), -band_score);
  const Halves outer = cut_at_zero(*mesh, "outer");
  const Halves inner = cut_at_zero(*outer.above, "inner");
  paint(*inner.above, kSurelyTumour);
  paint(*inner.below, kUnsure);
  paint(*outer.below, kHealthy);
}

void TissueScene::draw_curves(const Outcome& outcome, const std::string& kind,
                              const LineStyle& style) {
  const double lift = lift_next_layer();
  Shapes shapes;
  for (const Curve& curve : outcome.curves) {
    if (curve.kind != kind) continue;
    std::vector<Vec3> line;
    for (const Vec3& point : curve.points)
      line.push_back(view_.to_view_mm(point) + Vec3(0.0, 0.0, lift));
    for (const auto& piece : dashes(line, style.dash_px * mm_per_px_))
      shapes.line(piece, style.width_px * mm_per_px_);
  }
  add_unlit(*shapes.polygons(), style.colour);
}

void TissueScene::draw_border(const LineStyle& style) {
  const Vec3 lift(0.0, 0.0, lift_next_layer());
  Shapes shapes;
  for (const auto& [from, to] : view_.rim_mm)
    shapes.strip(from + lift, to + lift, style.width_px * mm_per_px_);
  add_unlit(*shapes.polygons(), style.colour);
}

void TissueScene::draw_touches(const std::vector<Touch>& touches, double radius_px) {
  const std::array<Touch, 4> examples = {Touch{.on_the_way = true}, Touch{}, Touch{.initial = true},
                                         Touch{.set_aside = true}};
  const auto group_of = [](const Touch& touch) {
    return touch.set_aside ? 3u : touch.on_the_way ? 0u : touch.initial ? 2u : 1u;
  };
  for (const Touch& example : examples) {
    const TouchLook look = look_of(example, radius_px);
    const double rim_lift = lift_next_layer();
    const double core_lift = rim_lift + 0.5 * kLayerStep_px * mm_per_px_;
    Shapes rim;
    Shapes core;
    for (const Touch& touch : touches) {
      if (group_of(touch) != group_of(example)) continue;
      const Vec3 place = view_.to_view_mm(touch.position);
      rim.disc(place + Vec3(0.0, 0.0, rim_lift), look.radius_px * mm_per_px_);
      core.disc(place + Vec3(0.0, 0.0, core_lift), look.radius_px * look.core_share * mm_per_px_);
    }
    add_unlit(*rim.polygons(), look.rim);
    add_unlit(*core.polygons(), look.core);
  }
}

void TissueScene::finish() {
  const double depth = view_.front_mm - view_.back_mm + (layers_ + 4) * kLayerStep_px * mm_per_px_;
  const Vec3 middle(view_.left_mm + view_.width_mm / 2.0, view_.bottom_mm + view_.height_mm / 2.0,
                    view_.front_mm);
  vtkCamera* camera = renderer_.GetActiveCamera();
  camera->ParallelProjectionOn();
  camera->SetFocalPoint(middle.data());
  camera->SetPosition(middle.x(), middle.y(), middle.z() + 2.0 * depth);
  camera->SetViewUp(0.0, 1.0, 0.0);
  camera->SetParallelScale(view_.height_mm / 2.0);
  camera->SetClippingRange(0.5 * depth, 4.0 * depth);
}

double TissueScene::lift_next_layer() { return ++layers_ * kLayerStep_px * mm_per_px_; }

void TissueScene::add_unlit(vtkPolyData& shapes, Colour colour) {
  if (shapes.GetNumberOfPolys() == 0) return;
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(&shapes);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  set_colour(*actor->GetProperty(), colour);
  set_light(*actor->GetProperty(), /*lit=*/false);
  renderer_.AddActor(actor);
}

TouchLook look_of(const Touch& touch, double radius_px) {
  if (touch.set_aside) return {radius_px, kInk, kAmber, 0.7};
  if (touch.on_the_way) return {0.45 * radius_px, kInk, kInk, 0.5};
  if (touch.initial) return {radius_px, kInk, kWhite, 0.66};
  return {radius_px, kWhite, kInk, 0.74};
}

}  // namespace palpation::draw
