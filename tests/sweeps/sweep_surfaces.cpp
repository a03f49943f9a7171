// Surfaces from contacts, held against contacts that they were not shown: a tenth of each file's,
// chosen at random.
//   sweep_surfaces [--unit mm|cm|m] [--by projection|front] [--splits N] FILE...
//   sweep_surfaces [--splits N] --made dome|saddle|wave|cylinder ...
// For each: the median over the splits of the rms error of the surface at the held-out contacts
// along its normal, and which part of them all lies within 1.96 sqrt(height_sd^2 + contact_sd^2),
// what is far off included. Contacts beyond the rim are counted, not judged. Made ones scatter by
// kNoise_m about a phantom. Ends with 1 where a file cannot be read or joined, the median exceeds
// kMostError_m, or that part is not 90 to 98 %.
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
#include "palpation/geometry/make_phantom.h"
#include "palpation/geometry/reconstruct.h"
#include "palpation/io/contacts.h"

namespace {

using namespace palpation;

constexpr double kNoise_m = 5e-5;       // of contacts that are made
constexpr double kMostError_m = 15e-5;  // three times that
constexpr double kContacts_m = 1.5e-3;  // from one to the next

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

/// What a probe would find that meets a phantom, scattered along its normal.
ContactsFile made(const std::string& shape) {
  const Sheet sheet = shape == "dome"     ? dome_sheet()
                      : shape == "saddle" ? saddle_sheet()
                      : shape == "wave"   ? wave_sheet()
                                          : cylinder_sheet();
  Random random(1);
  const PhantomMesh phantom = make_phantom(sheet, kContacts_m, 0.3, random);
  ContactsFile file;
  file.points = phantom.mesh.vertices;
  file.outward = file.points;
  for (Eigen::Index i = 0; i < file.points.rows(); ++i) {
    file.outward.row(i) = sheet.normal(phantom.parameters.row(i));
    file.points.row(i) += kNoise_m * random.normal() * file.outward.row(i);
  }
  return file;
}

bool look_at(const std::string& name, const ContactsFile& file, Triangulation by, int splits) {
  const Points outward =
      file.outward.rows() > 0
          ? file.outward
          : Points(Vec3(0.0, 0.0, 1.0).transpose().replicate(file.points.rows(), 1));
  Random random(1);
  std::vector<double> rms_m;
  Score all;
  const auto start = std::chrono::steady_clock::now();
  for (int i = 0; i < splits; ++i) {
    const Score score = split(file, outward, by, random);
    rms_m.push_back(std::sqrt(score.square / std::max(score.count, 1)));
    all.count += score.count;
    all.within += score.within;
    all.beyond += score.beyond;
  }
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  std::sort(rms_m.begin(), rms_m.end());
  const double median_m = rms_m[rms_m.size() / 2],
               within_percent = 100.0 * all.within / std::max(all.count, 1);
  std::printf(
      "%-26s %6ld contacts  rms %.3f mm (%.3f to %.3f)  within %.1f %% of %d  beyond %d  "
      "%.1f s each\n",
      name.substr(name.rfind('/') + 1).c_str(), static_cast<long>(file.points.rows()),
      1e3 * median_m, 1e3 * rms_m.front(), 1e3 * rms_m.back(), within_percent, all.count,
      all.beyond, seconds / splits);
  std::fflush(stdout);
  return median_m <= kMostError_m && within_percent >= 90.0 && within_percent <= 98.0;
}

}  // namespace

int main(int count, char** words) {
  ContactColumns columns;
  Triangulation by = Triangulation::Chosen;
  int splits = 5;
  bool good = true;
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
      } else if (word == "--made" && i + 1 < count) {
        const std::string shape = words[++i];
        good = look_at(shape, made(shape), by, splits) && good;
      } else {
        good = look_at(word, read_contacts(word, columns), by, splits) && good;
      }
    } catch (const std::exception& error) {
      std::printf("%s: %s\n", word.c_str(), error.what());
      good = false;
    }
  }
  return good ? 0 : 1;
}
