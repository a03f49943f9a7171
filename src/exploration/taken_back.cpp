#include "exploration/taken_back.h"

#include "palpation/readings/screening.h"
#include "readings/readings.h"

namespace palpation {
namespace {

/// A surface ends there: no farther off does rounding or a coarse border put a place.
constexpr double kBeyond_m = 0.0005;

void take_back(const Surface& surface, const Misfit& change, std::size_t number,
               Palpation& palpation) {
  if (palpation.kind == TouchKind::Missed) return;
  if (change.kind == MisfitKind::Zero) palpation.reading -= change.amount;
  if (change.kind == MisfitKind::Drift)
    palpation.reading -= change.background.drift[static_cast<Eigen::Index>(number)];
  else if (is_background(change))
    palpation.reading -= added_at(surface, change.background, palpation.where);
  if (change.kind == MisfitKind::Gain)
    palpation.reading = change.low + (palpation.reading - change.low) / (1.0 + change.amount);
  if (!is_displacement(change)) return;
  const Vec3 off_m =
      change.kind == MisfitKind::Moved ? change.moved_m : change.amount * palpation.travel;
  const Vec3 lay = surface.position(palpation.where) - off_m;
  palpation.where = surface.project(lay);
  const Vec3 off = lay - surface.position(palpation.where),
             normal = surface.normal(palpation.where);
  if ((off - off.dot(normal) * normal).norm() > kBeyond_m && palpation.set_aside.empty())
    palpation.set_aside = kBeyondTissue;
}

constexpr std::ptrdiff_t kOneIn = 20;  ///< a moment is known to a few readings

}  // namespace

double added_at(const Surface& surface, const Unevenness& background, const SurfacePoint& where) {
  const double slope = background.slope_per_m.dot(surface.position(where) - background.middle);
  return background.waves.size() == 0 ? slope
                                      : slope + surface.interpolate(background.waves, where);
}

Misfit as_of_its_session(Misfit change, std::span<const Misfit> changes,
                         std::span<const Palpation> palpations) {
  if (change.kind != MisfitKind::Zero && change.kind != MisfitKind::Gain) return change;
  for (const Misfit& session : changes) {
    if (session.session == 0) continue;
    std::ptrdiff_t others = 0;
    for (std::size_t i = 0; i < palpations.size(); ++i) {
      const Made made = made_of(palpations, i);
      others += is_since(change, made) != is_since(session, made);
    }
    if (kOneIn * others > std::ssize(palpations)) continue;
    change.session = session.session;
    change.from_batch = session.from_batch;
    change.number = session.number;
    break;
  }
  return change;
}

std::vector<Palpation> with_changes_taken_back(const Surface& surface,
                                               std::vector<Palpation> palpations,
                                               std::span<const Misfit> changes) {
  for (std::size_t i = 0; i < palpations.size(); ++i) {
    const Made made = made_of(palpations, i);
    for (const Misfit& change : changes) {
      if (is_since(change, made)) take_back(surface, change, made.number, palpations[i]);
    }
  }
  return palpations;
}

}  // namespace palpation
