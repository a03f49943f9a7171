#include "experiments/study.h"

#include <cstdio>

#include "scene/draw_program.h"
#include "scene/single_file.h"

namespace palpation::tool {

std::vector<Figures> Results::of(std::size_t cell) const {
  std::vector<Figures> figures;
  for (const Row& row : rows) {
    if (row.key.cell == cell) figures.push_back(row.figures);
  }
  return figures;
}

std::vector<double> values_of(std::span<const Figures> rows, const std::string& name) {
  std::vector<double> values;
  for (const Figures& row : rows) {
    if (const std::optional<double> value = row.maybe_number(name)) values.push_back(*value);
  }
  return values;
}

void ReportFolder::write(const std::string& name, const std::string& csv) const {
  if (!folder.empty()) write_single_file(folder / (name + ".csv"), csv, Existing::Replaced);
}

void ReportFolder::draw(const std::string& name, const std::vector<std::string>& options) const {
  if (folder.empty()) return;
  std::vector<std::string> arguments = {"--curves", (folder / (name + ".csv")).string(),
                                        (folder / (name + ".png")).string()};
  arguments.insert(arguments.end(), options.begin(), options.end());
  if (const auto why = run_draw(arguments))
    std::fprintf(stderr, "palpate: no picture: %s\n", why->c_str());
}

}  // namespace palpation::tool
