#include "belief/sites.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <tuple>
#include <utility>

#include "palpation/base/error.h"
#include "readings/readings.h"

namespace palpation {
namespace {

/// In the intrinsic metric two sheets may touch: their modes differ, and so does the sum.
using PlaceKey = std::tuple<double, double, double, double>;

void check(const Palpation& palpation, std::size_t number) {
  const std::string name = "palpation " + std::to_string(number);
  require(std::isfinite(palpation.reading), "Belief",
          name + ": reading " + text_of(palpation.reading), "must be finite");
  const double variance = palpation.noise_variance;
  require(std::isnan(variance) || (std::isfinite(variance) && variance >= 0.0), "Belief",
          name + ": noise variance " + text_of(variance), "must be finite and not negative");
}

/// Exact readings say the same or contradict each other.
MergedReading merge_exact(const std::vector<double>& readings) {
  for (double reading : readings) {
    require(reading == readings.front(), "Belief",
            "readings " + text_of(readings.front()) + " and " + text_of(reading) + " at one place",
            "contradict each other, since both are without noise");
  }
  return {readings.front(), 0.0};
}

}  // namespace

std::vector<Site> gather_sites(const Prior& prior, std::span<const Palpation> palpations,
                               std::size_t first) {
  std::vector<Site> sites;
  std::map<PlaceKey, std::size_t> site_at;
  for (std::size_t number = first; number < palpations.size(); ++number) {
    const Palpation& palpation = palpations[number];
    if (!palpation.set_aside.empty()) continue;
    check(palpation, number);
    Place place = prior.place(palpation.where);
    const Vec3& x = place.coordinates;
    const auto [entry, is_new] =
        site_at.try_emplace(PlaceKey(x.x(), x.y(), x.z(), place.modes.sum()), sites.size());
    if (is_new) sites.push_back({palpation.where, std::move(place), {}, {}, {}});
    Site& site = sites[entry->second];
    site.made.push_back(made_of(palpations, number));
    if (std::isnan(palpation.noise_variance)) {
      site.plain.push_back(palpation.reading);
    } else {
      site.known.push_back(palpation.reading);
      site.known_variances.push_back(palpation.noise_variance);
    }
  }
  return sites;
}

MergedReading merge(const Site& site, double field_noise_variance) {
  std::vector<double> exact;
  if (field_noise_variance == 0.0) exact = site.plain;
  for (std::size_t k = 0; k < site.known.size(); ++k) {
    if (site.known_variances[k] == 0.0) exact.push_back(site.known[k]);
  }
  if (!exact.empty()) return merge_exact(exact);

  // Offsets from one of the readings, so that a large common value costs no digits, and variances
  // over a power of two near the least of them, so that no precision overflows.
  const double origin = site.plain.empty() ? site.known.front() : site.plain.front();
  double least = site.plain.empty() ? site.known_variances.front() : field_noise_variance;
  for (double variance : site.known_variances) least = std::min(least, variance);
  const int exponent = std::ilogb(least);
  double precision = 0.0;
  double weighted = 0.0;
  const auto add = [&](double reading, double scaled_variance) {
    precision += 1.0 / scaled_variance;
    weighted += (reading - origin) / scaled_variance;
  };
  const double scaled_noise = std::ldexp(field_noise_variance, -exponent);
  for (double reading : site.plain) add(reading, scaled_noise);
  for (std::size_t k = 0; k < site.known.size(); ++k)
    add(site.known[k], std::ldexp(site.known_variances[k], -exponent));
  if (site.plain.size() + site.known.size() == 1) {
    return {origin, site.known.empty() ? field_noise_variance : site.known_variances.front()};
  }
  return {origin + weighted / precision, std::ldexp(1.0 / precision, exponent)};
}

double scatter_log_likelihood(const Site& site, double field_noise_variance) {
  const std::size_t count = site.plain.size() + site.known.size();
  const MergedReading merged = merge(site, field_noise_variance);
  if (count == 1 || merged.variance == 0.0) return 0.0;
  double sum = -std::log(merged.variance) +
               static_cast<double>(count - 1) * std::log(2.0 * std::numbers::pi);
  const auto add = [&](double reading, double variance) {
    sum += (reading - merged.mean) * (reading - merged.mean) / variance + std::log(variance);
  };
  for (double reading : site.plain) add(reading, field_noise_variance);
  for (std::size_t k = 0; k < site.known.size(); ++k) add(site.known[k], site.known_variances[k]);
  return -0.5 * sum;
}

}  // namespace palpation
