// Measurements as CSV, up to the belief that they make.
#include "palpation/io/measurements.h"

#include "fuzz/target.h"
#include "palpation/base/error.h"
#include "palpation/belief/belief.h"

namespace palpation::fuzz {
namespace {

constexpr std::size_t kFew = 60;

void believe(const Surface& surface, const std::vector<Palpation>& palpations) {
  const Prior prior(surface, Metric::Chart, {.length_m = 0.005, .signal_sd = 1.0});
  const Marginals marginals =
      Belief(prior, {.noise_sd = 0.1}).condition_on(palpations).at_vertices();
  expect(marginals.mean.allFinite() && marginals.variance.allFinite(), "a belief is finite");
  expect(marginals.variance.minCoeff() >= 0.0, "variances are not negative");
}

}  // namespace
}  // namespace palpation::fuzz

int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace palpation;
  const fuzz::MemoryFile file(bytes, size);
  try {
    const MeasurementsFile read = read_measurements(file.path(), fuzz::sheet());
    if (read.palpations.size() <= fuzz::kFew) fuzz::believe(fuzz::sheet(), read.palpations);
  } catch (const Error&) {
  }
  return 0;
}
