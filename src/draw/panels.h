/// The panels of a picture, each by itself: what is believed, how sure that is, where the boundary
/// ends.
#pragma once

#include <optional>
#include <string>

#include "draw/outcome.h"
#include "draw/sheet.h"
#include "draw/view.h"
#include "results/limits.h"

namespace palpation::draw {

enum class Panel {
  Mean,         ///< with the touches
  Uncertainty,  ///< the standard deviation, or the acquisition where there is none
  Boundary,     ///< with band and cut line, seen closer; where no band is known, with a truth the
                ///< margins, else the probability inside, else the mean
};

/// What colours are to run between, where that is not left to the run itself: several runs compare
/// only by the same.
struct ColourWish {
  std::optional<results::Limits> mean_limits, stddev_limits;
};

/// What the panel of the boundary shows.
enum class Third { Band, Margins, Probability, Mean };

struct PanelPlan {
  ColourWish wish;
  std::optional<double> level = {};        ///< of the estimate
  std::optional<double> truth_level = {};  ///< of the truth
  Third third = Third::Mean;
  View view = {};
  View close_up = {};  ///< of the boundary
};

/// Throws IoError if the surface holds no field named mean.
PanelPlan plan_of(const Outcome& outcome, const ColourWish& wish = {});

/// What is seen in a panel.
const View& view_in(const PanelPlan& plan, Panel panel);

/// Draws into a map's box and the room that a layout leaves around it.
void draw_panel(Sheet& sheet, const Outcome& outcome, const PanelPlan& plan, Panel panel,
                const Box& map, const std::string& letter);

}  // namespace palpation::draw
