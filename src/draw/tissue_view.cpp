#include "draw/tissue_view.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkClipPolyData.h>
#include <vtkDoubleArray.h>
#include <vtkLight.h>
#include <vtkLookupTable.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataNormals.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>

#include <Eigen/Geometry>
#include <array>

#include "draw/shapes.h"

namespace palpation::draw {
namespace {

constexpr double kHatch_px = 12.0;  // across the lines twice the root of a half of that
constexpr double kHatchLine_px = 1.3;
constexpr double kVeil = 0.65;
constexpr double kLayerStep_px = 2.5;  // towards the viewer, from one layer of ink to the next

vtkSmartPointer<vtkPolyData> turned(vtkPolyData& mesh, const View& view) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(mesh.GetNumberOfPoints());
  Vec3 place;
  for (vtkIdType i = 0; i < mesh.GetNumberOfPoints(); ++i) {
    mesh.GetPoint(i, place.data());
    points->SetPoint(i, view.to_view_mm(place).data());
  }
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

// Shading that shows the shape of curved tissue; what faces the viewer keeps the colours of a map.
void set_light(vtkProperty& property, bool lit) {
  property.SetLighting(lit);
  property.SetAmbient(lit ? 0.5 : 1.0);
  property.SetDiffuse(lit ? 0.6 : 0.0);
  property.SetSpecular(0.0);
  property.SetInterpolationToPhong();
}

void set_colour(vtkProperty& property, Colour colour) {
  property.SetColor(colour.red / 255.0, colour.green / 255.0, colour.blue / 255.0);
}

}  // namespace

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

void TissueScene::draw_not_searched(const Outcome& outcome) {
  if (outcome.is_searched()) return;
  const vtkSmartPointer<vtkPolyData> mesh = turned(*outcome.surface, view_);
  add_field(*mesh, "beyond", *outcome.field(kBeyondSearch), 0.0);
  const vtkSmartPointer<vtkPolyData> part = cut_at_zero(*mesh, "beyond").above;
  const Vec3 lift(0.0, 0.0, lift_next_layer());
  vtkNew<vtkPolyData> veil;
  veil->DeepCopy(part);
  vtkNew<vtkDoubleArray> stripe;
  stripe->SetName("stripe");
  Vec3 place;
  for (vtkIdType i = 0; i < part->GetNumberOfPoints(); ++i) {
    part->GetPoint(i, place.data());
    stripe->InsertNextValue((place.x() + place.y()) / (kHatch_px * mm_per_px_));
    veil->GetPoints()->SetPoint(i, (place + lift).eval().data());
  }
  part->GetPointData()->SetScalars(stripe);
  add_veil(*veil);
  add_unlit(*hatching(*part, lift_next_layer(), kHatchLine_px * mm_per_px_), kGrey);
}

void TissueScene::add_veil(vtkPolyData& part) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(&part);
  mapper->ScalarVisibilityOff();
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  set_colour(*actor->GetProperty(), kPaleGrey);
  set_light(*actor->GetProperty(), /*lit=*/false);
  actor->GetProperty()->SetOpacity(kVeil);
  renderer_.AddActor(actor);
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
  const std::array<Touch, 5> examples = {Touch{.on_the_way = true}, Touch{}, Touch{.initial = true},
                                         Touch{.set_aside = true}, Touch{.planned = true}};
  const auto group_of = [](const Touch& touch) {
    return touch.planned      ? 4u
           : touch.set_aside  ? 3u
           : touch.on_the_way ? 0u
           : touch.initial    ? 2u
                              : 1u;
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
  vtkNew<vtkLight> upper_left;
  upper_left->SetLightTypeToCameraLight();
  upper_left->SetPosition(-0.35, 0.45, 0.82);
  upper_left->SetFocalPoint(0.0, 0.0, 0.0);
  renderer_.AddLight(upper_left);
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
  if (touch.planned) return {1.25 * radius_px, kWhite, kNext, 0.74};
  if (touch.set_aside) return {radius_px, kInk, kAmber, 0.7};
  if (touch.on_the_way) return {0.45 * radius_px, kInk, kInk, 0.5};
  if (touch.initial) return {radius_px, kInk, kWhite, 0.66};
  return {radius_px, kWhite, kInk, 0.74};
}

}  // namespace palpation::draw
