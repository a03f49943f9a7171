/// What a run left in its output folder, as far as a picture shows it.
#pragma once

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "draw/table.h"
#include "palpation/base/types.h"

namespace palpation::draw {

/// The field of what was not searched: not negative there.
inline constexpr const char* kBeyondSearch = "beyond_search";

struct Touch {
  Vec3 position = Vec3::Zero();  ///< metres
  bool initial = false;          ///< of the design, before anything was known
  bool on_the_way = false;       ///< read while sliding to the next stop
  bool set_aside = false;        ///< not used
  bool planned = false;          ///< not touched yet: of a plan's next batch
  int index = 0;                 ///< of a planned one: its row in waypoints.csv, from 0
};

struct Curve {
  std::string kind;          ///< "estimate", "truth", "band_inner", "band_outer", "cut", ...
  std::vector<Vec3> points;  ///< metres; the first is repeated at the end
};

struct ErrorNumbers {
  std::optional<double> symmetric_difference_mm2, missed_mm2, extra_mm2, percent_of_search_area,
      dice;
};

struct BandNumbers {
  std::optional<double> probability, score, half_width_mm, inner_area_mm2, outer_area_mm2;
};

/// No tumour is wider than this, with that probability.
struct RuledOut {
  double diameter_mm = 0.0;
  std::optional<double> probability;
};

struct Summary {
  std::optional<BandNumbers> band;
  std::optional<double> cut_risk;
  std::string truth_line;             ///< what the true boundary is, for the legend
  std::optional<RuledOut> ruled_out;  ///< where nothing was found
  std::optional<double> level, area_mm2, expected_error_mm2, measurements, noise_sd;
  std::optional<ErrorNumbers> error;
  std::string reading_unit;                    ///< empty if nobody said
  std::optional<Eigen::Matrix4d> from_tissue;  ///< of a plan that is to be carried out yet
};

struct Outcome {
  vtkSmartPointer<vtkPolyData> surface;  ///< metres, with named arrays at the points
  std::vector<Curve> curves;
  std::vector<Touch> touches;
  std::optional<Table> trace;
  Summary summary;
  bool unrolled = false;  ///< laid flat: coordinates are the chart's

  /// The field of that name, or null.
  vtkDataArray* field(const std::string& name) const;
  bool has_curve(const std::string& kind) const;
  /// Whether a reading that counts is near every vertex (results/parts.h), or nobody says what was
  /// felt.
  bool is_searched() const;
  /// Whether it is known where the band lies: its score, and the field of it.
  bool shows_band() const;
  /// The level whose contours the curves of a kind are. Where a curve follows the border of the
  /// tissue the field lies above the level, so this is a low quantile of the field along the
  /// curves.
  std::optional<double> level_along(const std::string& kind, const std::string& field) const;
};

/// Reads surface.vtp, or the last step of a run that did not end, and boundary.vtp,
/// measurements.csv, trace.csv and summary.json where they exist, and a plan's waypoints.csv.
/// Throws IoError with path and reason.
Outcome read_outcome(const std::filesystem::path& folder);

}  // namespace palpation::draw
