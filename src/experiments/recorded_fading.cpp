// R5 and R6: where contact fades, the band says so.
#include <algorithm>
#include <cmath>

#include "experiments/recorded.h"
#include "palpation/readings/screening.h"
#include "readings/contact.h"
#include "scene/setup.h"

namespace palpation::tool {
namespace {

/// What is believed of a dense recording, screened and thinned.
struct Believed {
  Recorded recording;
  std::vector<Palpation> screened_readings;
  Exploration exploration;
};

Believed believed(const ExperimentArguments& arguments, const Scene& scene,
                  const std::string& name) {
  Recorded recording = recorded(arguments, name);
  std::vector<Palpation> all = screened(recording.tissue, recording.palpations);
  Exploration exploration(recording.tissue, model_of(scene), plan_of(scene));
  exploration.take_up(thinned(all));
  return {std::move(recording), std::move(all), std::move(exploration)};
}

/// Mean half width of the band on the side of the tissue where contact is better (false) or worse
/// (true).
double half_width_mm(const Believed& one, const FadingContact& fading, bool worse) {
  const Surface& tissue = one.recording.tissue;
  const Certainty& certainty = *one.exploration.conclusion().certainty;
  const std::vector<Vec3> boundary = points_of(tissue, certainty.score, 0.0);
  std::vector<double> along;
  for (const Vec3& point : boundary) along.push_back(point.dot(fading.towards));
  if (along.empty()) return 0.0;
  std::nth_element(along.begin(), along.begin() + static_cast<std::ptrdiff_t>(along.size() / 2),
                   along.end());
  const double middle = along[along.size() / 2];
  double area = 0.0, length = 0.0;
  for (int vertex = 0; vertex < tissue.vertex_count(); ++vertex) {
    const bool is_there = (tissue.vertex(vertex).dot(fading.towards) > middle) == worse;
    if (is_there && std::abs(certainty.score[vertex]) <= certainty.band_score)
      area += tissue.vertex_areas()[vertex];
  }
  for (const LevelLoop& loop : level_loops(tissue, certainty.score, 0.0)) {
    for (std::size_t i = 0; i < loop.points.size(); ++i) {
      const Vec3 here = tissue.position(loop.points[i]),
                 next = tissue.position(loop.points[(i + 1) % loop.points.size()]);
      if (!loop.on_border[i] && (here.dot(fading.towards) > middle) == worse)
        length += (next - here).norm();
    }
  }
  return length > 0.0 ? 500.0 * area / length : 0.0;
}

}  // namespace

void add_fading(const ExperimentArguments& arguments, const Scene& scene,
                std::vector<Figure>& figures) {
  std::optional<Believed> first;
  for (const std::string name : {"exp4", "exp7", "exp9", "exp10"}) {
    Believed now = believed(arguments, scene, name);
    const bool has_boundary =
        now.exploration.conclusion().level && now.exploration.conclusion().certainty &&
        !points_of(now.recording.tissue, now.exploration.conclusion().certainty->score, 0.0)
             .empty();
    figures.push_back({"R5", name + ": boundaries found", has_boundary ? 1.0 : 0.0, 1.0, 1.0});
    const std::optional<FadingContact> contact =
        fading_contact(now.recording.tissue, now.screened_readings);
    figures.push_back(
        {"R5", name + ": warnings that contact fades", contact ? 1.0 : 0.0, 1.0, 1.0});
    if (contact && has_boundary) {
      const double ratio = half_width_mm(now, *contact, true) / half_width_mm(now, *contact, false);
      figures.push_back({"R5", name + ": band there over band elsewhere", ratio, 1.0, 1e3});
    }
    if (name == "exp4" && has_boundary) first = std::move(now);
    if (name != "exp7" || !first || !has_boundary) continue;
    const Surface& tissue = first->recording.tissue;
    const Certainty& band = *first->exploration.conclusion().certainty;
    int inside = 0, all = 0;
    for (const Vec3& point :
         points_of(now.recording.tissue, now.exploration.conclusion().certainty->score, 0.0)) {
      ++all;
      if (std::abs(tissue.interpolate(band.score, tissue.project(point))) <= band.band_score)
        ++inside;
    }
    figures.push_back({"R6", "part of exp7's boundary in exp4's band",
                       static_cast<double>(inside) / all, 1.0, 1.0});
    figures.push_back(
        {"R6", "mean half width of exp4's band, mm", band.half_width_m * 1e3, 0.0, 1.5});
  }
}

}  // namespace palpation::tool
