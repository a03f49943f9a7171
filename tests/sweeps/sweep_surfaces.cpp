// Surfaces from recorded contacts, held against contacts that they were not shown: a tenth of each
// file's, chosen at random.
//   sweep_surfaces [--unit mm|cm|m] [--by projection|front] [--splits N] FILE...
// For each file: the median over the splits of the rms error of the surface at the held-out
// contacts along its normal, and which part of them all lies within 1.96 sqrt(height_sd^2 +
// contact_sd^2), what is far off included. Contacts beyond the rim are counted, not judged.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <numeric>
#include <string>
#include <vector>

#include "palpation/base/random.h"
#include "palpation/belief/height.h"
#include "palpation/geometry/reconstruct.h"
#include "palpation/io/contacts.h"

namespace {

using namespace palpation;

struct Score {
  double square = 0.0;
  int count = 0, within = 0, beyond = 0;
};

void judge(const Surface& surface, const HeightFit& fit, const Points& contacts, double reach_m,
           Score& score) {
  for (const auto& contact : contacts.rowwise()) {
    const SurfacePoint foot = surface.project(contact.transpose());
    const Vec3 offset = contact.transpose() - surface.position(foot);
    const Vec3 normal = surface.normal(foot);
    const double height = offset.dot(normal);
    if ((offset - height * normal).norm() > reach_m) {
      ++score.beyond;
      continue;
    }
    const double sd = std::hypot(surface.interpolate(fit.height_sd, foot), fit.contact_sd);
    ++score.count;
    score.within += std::abs(height) <= 1.96 * sd;
    score.square += height * height;
  }
}

std::vector<int> shuffled(Eigen::Index count, Random& random) {
  std::vector<int> order(static_cast<std::size_t>(count));
  std::iota(order.begin(), order.end(), 0);
  for (std::size_t i = order.size(); i > 1; --i)
    std::swap(order[i - 1], order[static_cast<std::size_t>(random.below(static_cast<int>(i)))]);
  return order;
}

Score split(const ContactsFile& file, const Points& outward, Triangulation by, Random& random) {
  const std::vector<int> order = shuffled(file.points.rows(), random);
  const auto middle = order.begin() + static_cast<std::ptrdiff_t>(order.size() / 10);
  const std::vector<int> held(order.begin(), middle), rest(middle, order.end());
  const Points contacts = file.points(rest, Eigen::all);
  const Reconstruction rough = reconstruct(contacts, outward(rest, Eigen::all), {.by = by});
  const HeightFit fit = fit_height(Surface(rough.mesh), contacts,
                                   {.spacing_m = rough.spacing_m, .reach_m = rough.spacing_m});
  Score score;
  judge(Surface(fit.mesh), fit, file.points(held, Eigen::all), rough.spacing_m, score);
  return score;
}

void look_at(const std::string& path, const ContactColumns& columns, Triangulation by, int splits) {
  const ContactsFile file = read_contacts(path, columns);
  const Points outward =
      file.outward.rows() > 0
          ? file.outward
          : Points(Vec3(0.0, 0.0, 1.0).transpose().replicate(file.points.rows(), 1));
  Random random(1);
  std::vector<double> rms_mm;
  Score all;
  const auto start = std::chrono::steady_clock::now();
  for (int i = 0; i < splits; ++i) {
    const Score score = split(file, outward, by, random);
    rms_mm.push_back(1e3 * std::sqrt(score.square / std::max(score.count, 1)));
    all.count += score.count;
    all.within += score.within;
    all.beyond += score.beyond;
  }
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  std::sort(rms_mm.begin(), rms_mm.end());
  std::printf(
      "%-26s %6ld contacts  rms %.3f mm (%.3f to %.3f)  within %.1f %% of %d  beyond %d  "
      "%.1f s each\n",
      path.substr(path.rfind('/') + 1).c_str(), static_cast<long>(file.points.rows()),
      rms_mm[rms_mm.size() / 2], rms_mm.front(), rms_mm.back(),
      100.0 * all.within / std::max(all.count, 1), all.count, all.beyond, seconds / splits);
  std::fflush(stdout);
}

}  // namespace

int main(int count, char** words) {
  ContactColumns columns;
  Triangulation by = Triangulation::Chosen;
  int splits = 5;
  for (int i = 1; i < count; ++i) {
    const std::string word = words[i];
    try {
      if (word == "--unit" && i + 1 < count) {
        columns.unit = length_unit(words[++i]);
      } else if (word == "--by" && i + 1 < count) {
        by = words[++i] == std::string("front") ? Triangulation::AdvancingFront
                                                : Triangulation::Projection;
      } else if (word == "--splits" && i + 1 < count) {
        splits = std::max(1, std::atoi(words[++i]));
      } else {
        look_at(word, columns, by, splits);
      }
    } catch (const std::exception& error) {
      std::printf("%s: %s\n", word.c_str(), error.what());
    }
  }
}
