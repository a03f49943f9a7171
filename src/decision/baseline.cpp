#include "palpation/decision/baseline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <string>

#include "decision/chart_locator.h"
#include "palpation/base/error.h"

namespace palpation {
namespace {

constexpr double kMostPlaces = 1e7;
constexpr double kMostRefinement = 0x1p20;

/// Places along a line of some length: whole steps, the rest shared out evenly at both ends.
struct Ruler {
  double length_m, step_m;
  double steps() const { return std::floor(length_m / step_m + 1e-9); }
  double at(double index) const { return 0.5 * (length_m - steps() * step_m) + index * step_m; }
};

void require_length(const std::string& function, const std::string& name, double length_m) {
  require(std::isfinite(length_m) && length_m > 0.0, function,
          name + " " + text_of(length_m) + " m", "must be positive and finite");
}

}  // namespace

std::vector<SurfacePoint> raster_scan(const Surface& surface, double spacing_m, double step_m) {
  require_length("raster_scan", "spacing", spacing_m);
  require_length("raster_scan", "step", step_m);
  const ChartLocator tissue(surface);
  const Vec2 extent = tissue.upper() - tissue.lower();
  const int along = extent.y() > extent.x() ? 1 : 0;
  const Ruler places{extent[along], step_m}, rows{extent[1 - along], spacing_m};
  require((places.steps() + 1.0) * (rows.steps() + 1.0) <= kMostPlaces, "raster_scan",
          "a row every " + text_of(spacing_m) + " m with a place every " + text_of(step_m) + " m",
          "must give at most 1e7 places");
  std::vector<SurfacePoint> scan;
  for (double row = 0.0; row <= rows.steps(); row += 1.0) {
    const bool goes_back = std::fmod(row, 2.0) == 1.0;
    for (double index = 0.0; index <= places.steps(); index += 1.0) {
      Vec2 place = tissue.lower();
      place[along] += places.at(goes_back ? places.steps() - index : index);
      place[1 - along] += rows.at(row);
      if (const auto point = tissue.at(place)) scan.push_back(*point);
    }
  }
  return scan;
}

RecursiveRefinement::RecursiveRefinement(Surface surface, double coarsest_m, double finest_m)
    : tissue_(std::make_shared<ChartLocator>(surface)), finest_step_m_(coarsest_m) {
  require_length("RecursiveRefinement", "coarsest", coarsest_m);
  require_length("RecursiveRefinement", "finest", finest_m);
  require(finest_m <= coarsest_m && coarsest_m <= kMostRefinement * finest_m, "RecursiveRefinement",
          "from " + text_of(coarsest_m) + " m to " + text_of(finest_m) + " m",
          "must get finer, by at most 2^20");
  while (finest_step_m_ > finest_m * (1.0 + 1e-9)) {
    finest_step_m_ *= 0.5;
    coarsest_size_ *= 2;
  }
  const Vec2 extent = tissue_->upper() - tissue_->lower();
  const Vec2 cells = (extent / finest_step_m_).array() - 1e-9;
  require((cells.x() + 2.0) * (cells.y() + 2.0) <= kMostPlaces, "RecursiveRefinement",
          "cells of " + text_of(finest_step_m_) + " m", "must give at most 1e7 places");
  columns_ = std::max(1, static_cast<int>(std::ceil(cells.x())));
  rows_ = std::max(1, static_cast<int>(std::ceil(cells.y())));
  nodes_.resize(static_cast<std::size_t>(columns_ + 1) * (rows_ + 1));
}

Vec2 RecursiveRefinement::position(int column, int row) const {
  return {
      column == columns_ ? tissue_->upper().x() : tissue_->lower().x() + column * finest_step_m_,
      row == rows_ ? tissue_->upper().y() : tissue_->lower().y() + row * finest_step_m_};
}

std::array<int, 4> RecursiveRefinement::corners(const Cell& cell) const {
  const int right = std::min(cell.column + cell.size, columns_),
            top = std::min(cell.row + cell.size, rows_);
  return {node(cell.column, cell.row), node(right, cell.row), node(cell.column, top),
          node(right, top)};
}

std::vector<RecursiveRefinement::Cell> RecursiveRefinement::cut(const Cell& region,
                                                                int size) const {
  std::vector<Cell> cells;
  for (int row = region.row; row < std::min(region.row + region.size, rows_); row += size) {
    for (int column = region.column; column < std::min(region.column + region.size, columns_);
         column += size) {
      cells.push_back({column, row, size});
    }
  }
  return cells;
}

bool RecursiveRefinement::straddles(const Cell& cell, double level) const {
  bool some_below = false, some_above = false;
  for (const int corner : corners(cell)) {
    if (nodes_[corner].state != State::Felt) continue;
    (nodes_[corner].reading < level ? some_below : some_above) = true;
  }
  return some_below && some_above;
}

std::vector<SurfacePoint> RecursiveRefinement::next(double level) {
  require(std::isfinite(level), "RecursiveRefinement::next", "level " + text_of(level),
          "must be finite");
  for (Node& node : nodes_) {
    if (node.state == State::Asked) node.state = State::Silent;
  }
  std::vector<SurfacePoint> places;
  // Every pass is one generation of cells; the readings decide anew which of them are cut, so that
  // the level may have moved since.
  std::vector<Cell> cells = cut({0, 0, std::max(columns_, rows_)}, coarsest_size_);
  while (!cells.empty()) {
    std::vector<Cell> finer;
    for (const Cell& cell : cells) {
      if (ask(cell, places) || cell.size == 1 || !straddles(cell, level)) continue;
      for (const Cell& quarter : cut(cell, cell.size / 2)) finer.push_back(quarter);
    }
    cells = std::move(finer);
  }
  return places;
}

bool RecursiveRefinement::ask(const Cell& cell, std::vector<SurfacePoint>& places) {
  bool waits = false;
  for (const int corner : corners(cell)) {
    Node& node = nodes_[corner];
    if (node.state == State::Unknown) {
      const auto point = tissue_->at(position(corner % (columns_ + 1), corner / (columns_ + 1)));
      node.state = point ? State::Asked : State::Silent;
      if (point) places.push_back(*point);
    }
    waits |= node.state == State::Asked;
  }
  return waits;
}

int RecursiveRefinement::nearest_node(const SurfacePoint& where) const {
  const Vec2 offset = tissue_->place(where) - tissue_->lower();
  const auto nearest = [&](double along, double extent, int last) {
    const int below = std::clamp(static_cast<int>(along / finest_step_m_), 0, last - 1);
    const double above_m = below + 1 == last ? extent : (below + 1) * finest_step_m_;
    return along - below * finest_step_m_ <= above_m - along ? below : below + 1;
  };
  const Vec2 extent = tissue_->upper() - tissue_->lower();
  return node(nearest(offset.x(), extent.x(), columns_), nearest(offset.y(), extent.y(), rows_));
}

void RecursiveRefinement::record(std::span<const Palpation> palpations) {
  for (const Palpation& palpation : palpations) {
    if (!palpation.set_aside.empty()) continue;
    Node& node = nodes_[nearest_node(palpation.where)];
    require(std::isfinite(palpation.reading), "RecursiveRefinement::record",
            "reading " + text_of(palpation.reading), "must be finite");
    require(node.state == State::Asked, "RecursiveRefinement::record",
            "a palpation of face " + std::to_string(palpation.where.face),
            "is not at a place of the last next()");
    node = {State::Felt, palpation.reading};
  }
}

}  // namespace palpation
