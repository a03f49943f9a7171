#include <algorithm>
#include <cmath>
#include <utility>

#include "exploration/background_search.h"
#include "palpation/exploration/conclusion.h"

namespace palpation {
namespace {

constexpr std::size_t kRemembered = 4;

bool same(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

/// Copies of one surface share its mesh.
bool same_prior(const Prior& a, const Prior& b) {
  const auto alike = [](const Kernel& one, const Kernel& other) {
    return one.family == other.family && one.length_m == other.length_m &&
           one.signal_sd == other.signal_sd && one.period_m == other.period_m;
  };
  return &a.surface().mesh() == &b.surface().mesh() && a.metric() == b.metric() &&
         alike(a.kernel(), b.kernel()) && a.constant().sd == b.constant().sd &&
         a.slope().sd == b.slope().sd && a.slope().origin == b.slope().origin &&
         a.lengths().least_m == b.lengths().least_m && a.lengths().most_m == b.lengths().most_m;
}

bool same_options(const BeliefOptions& a, const BeliefOptions& b) {
  return a.noise_sd == b.noise_sd && a.noise_is_relative == b.noise_is_relative &&
         a.standardize == b.standardize && a.reduced_rank_tolerance == b.reduced_rank_tolerance &&
         a.single_precision == b.single_precision;
}

bool same_reading(const Palpation& a, const Palpation& b) {
  return a.where.face == b.where.face && a.where.barycentric == b.where.barycentric &&
         a.reading == b.reading && same(a.noise_variance, b.noise_variance) && a.batch == b.batch &&
         a.session == b.session && a.kind == b.kind && a.travel == b.travel &&
         a.set_aside == b.set_aside && a.bound == b.bound && a.number == b.number;
}

/// How many of the first palpations the belief knows, and nothing else; 0 if it is another belief.
std::size_t known_of(const Belief& belief, const Belief& blank,
                     std::span<const Palpation> palpations) {
  const std::vector<Palpation>& known = belief.palpations();
  const bool is_prefix = known.size() <= palpations.size() &&
                         std::equal(known.begin(), known.end(), palpations.begin(), same_reading);
  return is_prefix && same_prior(belief.prior(), blank.prior()) &&
                 same_options(belief.options(), blank.options())
             ? known.size()
             : 0;
}

}  // namespace

Belief ConclusionCache::grown(const Belief& blank, std::span<const Palpation> palpations) {
  std::size_t known = last_ ? known_of(*last_, blank, palpations) : 0;
  // Half a batch that was known would leave other rounding than the whole one.
  if (known > 0 && known < palpations.size() &&
      palpations[known].batch == palpations[known - 1].batch)
    known = 0;
  Belief belief = known > 0 ? *last_ : blank;
  while (known < palpations.size()) {
    const auto rest = palpations.subspan(known);
    const auto last = std::ranges::find_if(
        rest, [&](const Palpation& one) { return one.batch != rest.front().batch; });
    const auto count = static_cast<std::size_t>(last - rest.begin());
    belief = belief.condition_on(rest.first(count));
    known += count;
  }
  last_ = std::make_shared<const Belief>(belief);
  return belief;
}

void ConclusionCache::foresee(std::span<const SurfacePoint> places) {
  if (last_) last_ = std::make_shared<const Belief>(last_->foresee(places));
}

std::shared_ptr<const TriedBackgrounds> ConclusionCache::tried(
    const Surface& surface, const Model& model, std::span<const Palpation> felt) const {
  const auto is_same = [&](const std::shared_ptr<const TriedBackgrounds>& one) {
    return &one->flat.believed.belief.prior().surface().mesh() == &surface.mesh() &&
           one->model == model && std::ranges::equal(one->felt, felt, same_reading);
  };
  const auto found = std::ranges::find_if(tried_, is_same);
  return found == tried_.end() ? nullptr : *found;
}

void ConclusionCache::remember(std::shared_ptr<const TriedBackgrounds> tried) {
  tried_.insert(tried_.begin(), std::move(tried));
  if (tried_.size() > kRemembered) tried_.pop_back();
}

}  // namespace palpation
