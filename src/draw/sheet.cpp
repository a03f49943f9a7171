#include "draw/sheet.h"

#include <vtkBrush.h>
#include <vtkContext2D.h>
#include <vtkContextActor.h>
#include <vtkContextItem.h>
#include <vtkContextScene.h>
#include <vtkExtractVOI.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPen.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkStdString.h>
#include <vtkTextProperty.h>
#include <vtkTextRenderer.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "draw/offscreen.h"

namespace palpation::draw {
namespace {

constexpr int kCircleCorners = 28;

using Stroke = std::function<void(vtkContext2D&)>;

// Repeats on VTK's canvas what was drawn on the sheet.
class StrokesItem : public vtkContextItem {
 public:
  static StrokesItem* New() { VTK_STANDARD_NEW_BODY(StrokesItem); }
  bool Paint(vtkContext2D* painter) override {
    for (const Stroke& stroke : strokes) stroke(*painter);
    return true;
  }
  std::vector<Stroke> strokes;
};

void paint_polygon(vtkContext2D& painter, const std::vector<float>& corners, Colour colour) {
  painter.GetPen()->SetLineType(vtkPen::NO_PEN);
  painter.GetBrush()->SetColor(colour.red, colour.green, colour.blue, colour.alpha);
  std::vector<float> mutable_corners = corners;
  painter.DrawPolygon(mutable_corners.data(), static_cast<int>(corners.size() / 2));
}

std::vector<float> scaled(const std::vector<Pixel>& points, double scale) {
  std::vector<float> result;
  result.reserve(points.size() * 2);
  for (const Pixel& point : points) {
    result.push_back(static_cast<float>(point.x() * scale));
    result.push_back(static_cast<float>(point.y() * scale));
  }
  return result;
}

std::vector<Pixel> corners_of(const Box& box) {
  return {{box.left, box.bottom},
          {box.right(), box.bottom},
          {box.right(), box.top()},
          {box.left, box.top()}};
}

void set_justification(vtkTextProperty& property, const TextStyle& style) {
  property.SetJustification(style.horizontal == Horizontal::Left     ? VTK_TEXT_LEFT
                            : style.horizontal == Horizontal::Centre ? VTK_TEXT_CENTERED
                                                                     : VTK_TEXT_RIGHT);
  property.SetVerticalJustification(style.vertical == Vertical::Bottom   ? VTK_TEXT_BOTTOM
                                    : style.vertical == Vertical::Centre ? VTK_TEXT_CENTERED
                                                                         : VTK_TEXT_TOP);
}

void set_up(vtkTextProperty& property, const TextStyle& style, double scale) {
  property.SetFontFamilyToArial();
  property.SetFontSize(static_cast<int>(std::lround(style.size_px * scale)));
  property.SetBold(style.bold);
  property.SetColor(style.colour.red / 255.0, style.colour.green / 255.0,
                    style.colour.blue / 255.0);
  property.SetOrientation(style.turned_deg);
  set_justification(property, style);
}

// A piece of a line as a rectangle; the discs at its ends, drawn apart, round the joints.
std::vector<Pixel> rectangle_along(const Pixel& from, const Pixel& to, double width_px) {
  const Pixel along = (to - from).normalized();
  const Pixel half = Pixel(-along.y(), along.x()) * (width_px / 2.0);
  return {from - half, to - half, to + half, from + half};
}

}  // namespace

struct Sheet::State {
  int width_px = 0;
  int height_px = 0;
  double scale = kSupersampling;
  vtkSmartPointer<vtkRenderWindow> window;
  vtkSmartPointer<vtkRenderer> ink;
  vtkNew<StrokesItem> strokes;
  std::vector<Mark> marks;
  std::vector<Box> scenes;
};

Sheet::Sheet(int width_px, int height_px, double scale) : state_(std::make_unique<State>()) {
  state_->width_px = width_px;
  state_->height_px = height_px;
  state_->scale = scale * kSupersampling;
  state_->window = offscreen_window(static_cast<int>(std::lround(scale * width_px)),
                                    static_cast<int>(std::lround(scale * height_px)));
  state_->window->SetNumberOfLayers(3);
  vtkNew<vtkRenderer> paper;
  paper->SetBackground(1.0, 1.0, 1.0);
  paper->SetLayer(0);
  state_->window->AddRenderer(paper);
  vtkNew<vtkContextActor> actor;
  actor->GetScene()->AddItem(state_->strokes);
  state_->ink = vtkSmartPointer<vtkRenderer>::New();
  state_->ink->SetLayer(2);
  state_->ink->AddActor(actor);
  actor->GetScene()->SetRenderer(state_->ink);
  state_->window->AddRenderer(state_->ink);
}

Sheet::~Sheet() = default;

int Sheet::width_px() const { return state_->width_px; }

int Sheet::height_px() const { return state_->height_px; }

void Sheet::line(const Pixel& from, const Pixel& to, const LineStyle& style) {
  polyline({from, to}, style);
}

void Sheet::polyline(const std::vector<Pixel>& points, const LineStyle& style) {
  std::vector<Eigen::Vector3d> whole;
  for (const Pixel& point : points) whole.emplace_back(point.x(), point.y(), 0.0);
  for (const auto& piece : dashes(whole, style.dash_px)) {
    for (std::size_t i = 0; i + 1 < piece.size(); ++i) {
      const Pixel from = piece[i].head<2>();
      const Pixel to = piece[i + 1].head<2>();
      if (from != to) fill(rectangle_along(from, to, style.width_px), style.colour);
      if (i > 0) disc(from, style.width_px / 2.0, style.colour);
    }
  }
}

void Sheet::fill(const Box& box, Colour colour) { fill(corners_of(box), colour); }

void Sheet::frame(const Box& box, const LineStyle& style) {
  std::vector<Pixel> corners = corners_of(box);
  corners.push_back(corners.front());
  polyline(corners, style);
}

void Sheet::fill(const std::vector<Pixel>& convex_polygon, Colour colour) {
  state_->marks.push_back({.corners = convex_polygon, .colour = colour, .words = {}, .style = {}});
  state_->strokes->strokes.push_back(
      [corners = scaled(convex_polygon, state_->scale), colour](vtkContext2D& painter) {
        paint_polygon(painter, corners, colour);
      });
}

void Sheet::disc(const Pixel& centre, double radius_px, Colour colour) {
  fill(circle(centre, radius_px), colour);
}

void Sheet::text(const Pixel& place, const std::string& words, const TextStyle& style) {
  state_->marks.push_back(
      {.corners = {}, .colour = style.colour, .words = words, .place = place, .style = style});
  const double scale = state_->scale;
  state_->strokes->strokes.push_back([place, words, style, scale](vtkContext2D& painter) {
    set_up(*painter.GetTextProp(), style, scale);
    painter.DrawString(static_cast<float>(place.x() * scale), static_cast<float>(place.y() * scale),
                       words);
  });
}

vtkRenderer& Sheet::scene(const Box& box) {
  auto renderer = vtkSmartPointer<vtkRenderer>::New();
  renderer->SetViewport(box.left / width_px(), box.bottom / height_px(), box.right() / width_px(),
                        box.top() / height_px());
  renderer->SetLayer(1);
  state_->scenes.push_back(box);
  state_->window->AddRenderer(renderer);
  return *renderer;
}

std::string Sheet::png() { return png_of(*state_->window); }

VectorPage Sheet::page() {
  VectorPage page{width_px(), height_px(), {}, state_->marks};
  state_->ink->DrawOff();
  const vtkSmartPointer<vtkImageData> whole = pixels_of(*state_->window);
  state_->ink->DrawOn();
  const double scale = state_->scale / kSupersampling;
  for (const Box& box : state_->scenes) {
    const auto edge = [&](double at, int most) {
      return std::clamp(static_cast<int>(std::lround(at * scale)), 0, most);
    };
    const int left = edge(box.left, whole->GetDimensions()[0] - 1);
    const int bottom = edge(box.bottom, whole->GetDimensions()[1] - 1);
    const int right = std::max(left + 1, edge(box.right(), whole->GetDimensions()[0]));
    const int top = std::max(bottom + 1, edge(box.top(), whole->GetDimensions()[1]));
    vtkNew<vtkExtractVOI> crop;
    crop->SetInputData(whole);
    crop->SetVOI(left, right - 1, bottom, top - 1, 0, 0);
    crop->Update();
    const Box exact{left / scale, bottom / scale, (right - left) / scale, (top - bottom) / scale};
    page.images.push_back({exact, crop->GetOutput()});
  }
  return page;
}

double text_width_px(const std::string& words, const TextStyle& style) {
  vtkNew<vtkTextProperty> property;
  set_up(*property, style, kSupersampling);
  property->SetOrientation(0.0);
  int bounds[4] = {0, 0, 0, 0};
  vtkTextRenderer* renderer = vtkTextRenderer::GetInstance();
  if (renderer == nullptr || !renderer->GetBoundingBox(property, words, bounds, /*dpi=*/72))
    return 0.0;
  return (bounds[1] - bounds[0] + 1) / static_cast<double>(kSupersampling);
}

std::vector<std::vector<Eigen::Vector3d>> dashes(const std::vector<Eigen::Vector3d>& line,
                                                 double dash) {
  if (dash <= 0.0 || line.size() < 2) return {line};
  std::vector<std::vector<Eigen::Vector3d>> result;
  bool drawing = true;
  double left = dash;
  result.push_back({line.front()});
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    Eigen::Vector3d from = line[i];
    double length = (line[i + 1] - from).norm();
    while (length > left) {
      from += (line[i + 1] - from) * (left / length);
      length -= left;
      if (drawing) {
        result.back().push_back(from);
      } else {
        result.push_back({from});
      }
      drawing = !drawing;
      left = dash;
    }
    left -= length;
    if (drawing) result.back().push_back(line[i + 1]);
  }
  return result;
}

std::vector<Pixel> circle(const Pixel& centre, double radius_px) {
  std::vector<Pixel> corners;
  corners.reserve(kCircleCorners);
  for (int i = 0; i < kCircleCorners; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kCircleCorners;
    corners.emplace_back(centre.x() + radius_px * std::cos(angle),
                         centre.y() + radius_px * std::sin(angle));
  }
  return corners;
}

}  // namespace palpation::draw
