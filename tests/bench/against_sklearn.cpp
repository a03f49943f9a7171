// Our side of against_sklearn.py: does on its tissue what a line on standard input says, with the
// library as the tool uses it, and answers with CPU seconds and what was found. Never part of
// ctest; see the script for how to run both.

#include <chrono>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <iostream>
#include <map>
#include <memory>
#include <sstream>
#include <string>

#include "base/tile.h"
#include "belief/likelihood.h"
#include "belief/sites.h"
#include "bench/tissue.h"
#include "palpation/base/parallel.h"
#include "palpation/belief/hyperparameters.h"
#include "palpation/decision/batch.h"

using namespace palpation;

namespace {

constexpr int kBatch = 10;
constexpr int kInitial = 5;

double cpu_seconds() {
  timespec now;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double wall_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Of the process: "VmHWM" at most since it was forgotten, "VmRSS" now.
double resident_mb(const std::string& which) {
  std::ifstream status("/proc/self/status");
  std::string word;
  double kilobytes = 0.0;
  while (status >> word) {
    if (word == which + ":") status >> kilobytes;
  }
  return kilobytes / 1024.0;
}

void forget_peak() { std::ofstream("/proc/self/clear_refs") << "5"; }

void write(const std::string& path, const Eigen::VectorXd& values,
           std::ios::openmode mode = std::ios::out) {
  std::ofstream(path, std::ios::binary | mode)
      .write(reinterpret_cast<const char*>(values.data()),
             static_cast<std::streamsize>(values.size() * static_cast<long>(sizeof(double))));
}

class Bench {
 public:
  Bench(int side, int readings) : scene_(side, readings) {}

  /// Places of the vertices, what would be felt at each, and the vertices touched.
  void describe(const std::string& path) const {
    const int count = scene_.surface.vertex_count();
    Eigen::VectorXd felt(count), touched(static_cast<Eigen::Index>(scene_.readings.size()));
    for (int vertex = 0; vertex < count; ++vertex) felt[vertex] = scene_.reading(vertex);
    for (std::size_t i = 0; i < scene_.readings.size(); ++i)
      touched[static_cast<Eigen::Index>(i)] = scene_.touched[i];
    const Points2& uv = scene_.surface.chart().uv;
    write(path, Eigen::Map<const Eigen::VectorXd>(uv.data(), uv.size()));
    write(path, felt, std::ios::app);
    write(path, touched, std::ios::app);
  }

  /// One planning iteration: the last ten of n readings come in, the next ten places are chosen.
  void iterate(const std::string& how, int n) {
    const Belief& before = known(how == "cold" ? 0 : n - kBatch);
    Belief prepared = before;
    if (how == "foreseen") {
      std::vector<SurfacePoint> places;
      for (const Palpation& palpation : first(n).subspan(before.palpations().size()))
        places.push_back(palpation.where);
      prepared = before.foresee(places);
    }
    last_.reset();
    const double start = cpu_seconds();
    last_ = std::make_unique<Belief>(
        prepared.condition_on(first(n).subspan(before.palpations().size())));
    const Batch batch = choose(*last_, Evaluation::Automatic);
    report(cpu_seconds() - start, batch);
  }

  void once(int n, const std::string& path) const {
    const double start = cpu_seconds();
    const Marginals marginals =
        marginals_once(scene_.blank.prior(), scene_.blank.options(), first(n));
    const double took = cpu_seconds() - start;
    write(path, marginals.mean);
    write(path, marginals.variance, std::ios::app);
    std::cout << took << std::endl;
  }

  void dump(const std::string& path) const {
    const Marginals marginals = last_->at_vertices();
    write(path, marginals.mean);
    write(path, marginals.variance, std::ios::app);
    std::cout << "0" << std::endl;
  }

  /// From the first readings on, batch after batch.
  void run(int batches) const {
    Belief belief = scene_.blank.condition_on(first(kInitial));
    Batch all;
    double took = 0.0;
    std::vector<Palpation> felt;
    for (int i = 0; i < batches; ++i) {
      const double start = cpu_seconds();
      if (!felt.empty()) belief = belief.condition_on(felt);
      const Batch batch = choose(belief, Evaluation::Automatic);
      took += cpu_seconds() - start;
      felt.clear();
      for (const int vertex : batch.vertices)
        felt.push_back(
            {.where = scene_.surface.at_vertex(vertex), .reading = scene_.reading(vertex)});
      all.vertices.insert(all.vertices.end(), batch.vertices.begin(), batch.vertices.end());
      all.evaluations += batch.evaluations;
    }
    report(took, all);
  }

  void greedy(const std::string& how, int n) {
    const Belief& belief = known(n);
    const double start = cpu_seconds();
    const Batch batch = choose(belief, how == "lazy" ? Evaluation::Lazy : Evaluation::Exhaustive);
    report(cpu_seconds() - start, batch);
  }

  /// Length, signal and noise by likelihood alone: CPU seconds and the log likelihood reached, then
  /// what was learned.
  void learn(int n, const Hyperparameters& start_values) const {
    const Prior& prior = scene_.blank.prior();
    const double start = cpu_seconds();
    const Hyperparameters found =
        palpation::learn(prior, first(n), start_values, {.likelihood_alone = true}).values;
    const double took = cpu_seconds() - start;
    std::cout << took << " " << log_likelihood(prior, gather_sites(prior, first(n)), found) << " "
              << found.length_m << " " << found.signal_sd << " " << found.noise_sd << std::endl;
  }

  /// Wall seconds of a step on so many threads.
  void threads(int count, const std::string& step, int n) {
    set_thread_count(count);
    const Belief& before = known(step == "build" ? 0 : n - kBatch);
    const double start = wall_seconds();
    const Belief after = before.condition_on(first(n).subspan(before.palpations().size()));
    std::cout << wall_seconds() - start << std::endl;
    set_thread_count(1);
  }

  /// What the process needs at most, less what it held before it was asked.
  void memory(const std::string& how, int n) const {
    forget_peak();
    const double before = resident_mb("VmRSS");
    if (how == "once") {
      marginals_once(scene_.blank.prior(), scene_.blank.options(), first(n));
    } else {
      Belief belief = scene_.blank.condition_on(first(kInitial));
      for (int known = kInitial; known < n; known += kBatch) {
        belief =
            belief.condition_on(first(known + kBatch).subspan(static_cast<std::size_t>(known)));
      }
      choose(belief, Evaluation::Automatic);
    }
    const double most = resident_mb("VmHWM");
    std::cout << most - before << " " << most << std::endl;
  }

 private:
  std::span<const Palpation> first(int n) const {
    return std::span(scene_.readings).first(static_cast<std::size_t>(n));
  }

  /// A belief of the first n readings, grown as in a run.
  const Belief& known(int n) {
    const auto found = beliefs_.find(n);
    if (found != beliefs_.end()) return found->second;
    Belief belief = scene_.blank.condition_on(first(std::min(n, kInitial)));
    for (int known = kInitial; known < n; known += kBatch) {
      belief = belief.condition_on(first(known + kBatch).subspan(static_cast<std::size_t>(known)));
    }
    beliefs_.clear();
    return beliefs_.emplace(n, std::move(belief)).first->second;
  }

  Batch choose(const Belief& belief, Evaluation evaluation) const {
    return choose_batch(belief, ils_ucb(0.5), kLevel, scene_.everywhere,
                        {.size = kBatch, .evaluation = evaluation});
  }

  static void report(double seconds, const Batch& batch) {
    std::cout << seconds << " " << batch.evaluations;
    for (const int vertex : batch.vertices) std::cout << " " << vertex;
    std::cout << std::endl;
  }

  Scene scene_;
  std::map<int, Belief> beliefs_;
  std::unique_ptr<Belief> last_;
};

/// Bytes per second at which this many are read again and again.
double read_bandwidth(long bytes) {
  const std::vector<double> values(static_cast<std::size_t>(bytes / 8), 1e-9);
  double best = 0.0;
  for (int round = 0; round < 8; ++round) {
    constexpr double kWeights[] = {1.0};
    alignas(64) double sums[2 * kLanes] = {};
    const double start = cpu_seconds();
    for (std::size_t i = 0; i + 512 <= values.size(); i += 512)
      add_sums(values.data() + i, 512 / kLanes, kWeights, 0, 0, sums);
    best = std::max(best, static_cast<double>(bytes) / (cpu_seconds() - start));
  }
  return best;
}

double exponentials_per_second() {
  std::vector<double> values(1024);
  double best = 0.0;
  for (int round = 0; round < 20; ++round) {
    const double start = cpu_seconds();
    for (int again = 0; again < 1000; ++again) {
      std::fill(values.begin(), values.end(), -0.01 * again);
      exponentials(values.data(), static_cast<long>(values.size()));
    }
    best = std::max(best, 1000.0 * static_cast<double>(values.size()) / (cpu_seconds() - start));
  }
  return best;
}

}  // namespace

int main() {
  set_thread_count(1);
  std::cout.precision(17);
  std::unique_ptr<Bench> bench;
  std::string line;
  while (std::getline(std::cin, line)) {
    std::istringstream words(line);
    std::string command, text;
    int number = 0, more = 0;
    words >> command;
    if (command == "scene") {
      words >> number >> more >> text;
      bench = std::make_unique<Bench>(number, more);
      if (!text.empty()) bench->describe(text);
      std::cout << "0" << std::endl;
    } else if (command == "iterate") {
      words >> text >> number;
      bench->iterate(text, number);
    } else if (command == "once") {
      words >> number >> text;
      bench->once(number, text);
    } else if (command == "dump") {
      words >> text;
      bench->dump(text);
    } else if (command == "run") {
      words >> number;
      bench->run(number);
    } else if (command == "greedy") {
      words >> text >> number;
      bench->greedy(text, number);
    } else if (command == "learn") {
      Hyperparameters from;
      words >> number >> from.length_m >> from.signal_sd >> from.noise_sd;
      bench->learn(number, from);
    } else if (command == "threads") {
      words >> number >> text >> more;
      bench->threads(number, text, more);
    } else if (command == "memory") {
      words >> text >> number;
      bench->memory(text, number);
    } else if (command == "bandwidth") {
      words >> number;
      std::cout << read_bandwidth(number) << std::endl;
    } else if (command == "exponentials") {
      std::cout << exponentials_per_second() << std::endl;
    } else {
      std::cerr << "what is '" << command << "'?\n";
      return 2;
    }
  }
}
