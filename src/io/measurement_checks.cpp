#include "io/measurement_checks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "palpation/base/error.h"
#include "readings/readings.h"

namespace palpation {
namespace {

constexpr double kRounding_m = 1e-15;
constexpr double kLeastRange = 1e-30;
constexpr std::size_t kEnoughForOutliers = 8;
constexpr double kFarOut =
    1000.0;  // times the width of the middle half: neither noise nor a tumour

double at_rank(std::vector<double> values, double share) {
  const auto rank = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + rank, values.end());
  return values[static_cast<std::size_t>(rank)];
}

}  // namespace

SurfacePoint Repeats::settle(const SurfacePoint& where, const Vec3& position, const CsvTable& table,
                             std::size_t row, double reading, bool exact) {
  const std::size_t number = places_.number_of(where, position);
  if (number == exact_rows_.size()) exact_rows_.emplace_back();
  if ((places_[number].position - position).norm() > kRounding_m) ++joined_;
  std::optional<Exact>& first = exact_rows_[number];
  if (exact && first && first->reading != reading) {
    fail_at_row(table, row,
                "the reading " + text_of(reading) + " contradicts " + text_of(first->reading) +
                    " in line " + std::to_string(table.line(first->row)) +
                    ": both are at one place and without noise");
  }
  if (exact && !first) first = Exact{row, reading};
  return places_[number].where;
}

void Repeats::tell(const std::string& name, std::vector<std::string>& warnings) const {
  if (joined_ == 0) return;
  warnings.push_back(name + ": " + std::to_string(joined_) +
                     (joined_ == 1 ? " position lies" : " positions lie") +
                     " within a nanometre of an earlier one, and counts as the same place.");
}

void tell_outliers(const CsvTable& table, const std::vector<std::size_t>& rows,
                   const std::vector<Palpation>& palpations, std::vector<std::string>& warnings) {
  const std::vector<double> used = used_readings(palpations);
  if (used.size() < kEnoughForOutliers) return;
  const double low = at_rank(used, 0.25), middle = at_rank(used, 0.5), high = at_rank(used, 0.75);
  if (!(high > low)) return;
  std::string lines;
  int count = 0;
  for (std::size_t i = 0; i < palpations.size(); ++i) {
    const Palpation& palpation = palpations[i];
    if (!counts(palpation) || std::abs(palpation.reading - middle) <= kFarOut * (high - low))
      continue;
    if (++count <= 5)
      lines += (lines.empty() ? "" : ", ") + std::to_string(table.line(rows[i])) + " (" +
               text_of(palpation.reading) + ")";
  }
  if (count == 0) return;
  warnings.push_back(
      table.name() + ": " +
      (count == 1 ? "1 reading stands" : std::to_string(count) + " readings stand") +
      " more than 1000 times as far out as the middle half of all readings is wide, in line " +
      lines + (count > 5 ? " and others" : "") +
      ". Only what others contradict is left out; if the probe slipped, say so in the column "
      "set_aside.");
}

void check_range(const CsvTable& table, const std::vector<Palpation>& palpations) {
  const std::vector<double> used = used_readings(palpations);
  if (all_equal(used)) return;
  const auto [least, most] = std::ranges::minmax(used);
  if (most - least < kLeastRange)
    throw IoError(
        table.name() + ": column reading: the readings differ by " + text_of(most - least) +
        " at most; where they differ it must be by 1e-30 at least: write them in another unit");
}

void set_aside_copies(const CsvTable& table, const std::vector<std::size_t>& rows,
                      const Surface& surface, std::vector<Palpation>& palpations,
                      std::vector<std::string>& warnings) {
  std::map<std::array<double, 3>, std::map<std::array<double, 7>, std::size_t>>
      known_at;  // by place, then reading, noise, batch, session and travel
  std::vector<std::pair<std::size_t, std::size_t>> copies;
  std::size_t revisits = 0;
  for (std::size_t i = 0; i < palpations.size(); ++i) {
    const Palpation& one = palpations[i];
    if (!counts(one)) continue;
    const Vec3 place = surface.position(one.where);
    auto& known = known_at[{place.x(), place.y(), place.z()}];
    revisits += !known.empty();
    const double noise = std::isnan(one.noise_variance) ? -1.0 : one.noise_variance;
    const Vec3& travel = one.travel;
    const auto [first, is_new] =
        known.try_emplace({one.reading, noise, static_cast<double>(one.batch),
                           static_cast<double>(one.session), travel.x(), travel.y(), travel.z()},
                          i);
    if (!is_new) copies.emplace_back(i, first->second);
  }
  if (copies.empty() || 2 * copies.size() < revisits) return;
  const auto line = [&](std::size_t i) { return std::to_string(table.line(rows[i])); };
  for (const auto& [copy, first] : copies)
    palpations[copy].set_aside = "copy of line " + line(first);
  const auto& [copy, first] = copies.front();
  const std::string words =
      copies.size() == 1
          ? " row repeats an earlier one, place and reading alike to every digit, and is"
          : " rows repeat earlier ones, place and reading alike to every digit, and are";
  warnings.push_back(table.name() + ": " + std::to_string(copies.size()) + words +
                     " set aside: line " + line(copy) + " repeats line " + line(first) + ".");
}

}  // namespace palpation
