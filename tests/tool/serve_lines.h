/// Lines for `palpate serve`: what a caller may say, and what becomes of it in bad hands.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "palpation/base/random.h"

namespace palpation::tool {

/// A line of a caller that means harm, or well.
inline std::string random_line(Random& random, const std::string& scene) {
  static const std::vector<std::string> kSound = {
      R"({"do":"next"})",
      R"({"do":"record","place":[0.01,0.01,0],"reading":7.1})",
      R"({"do":"record","place":[0.005,0.01,0.001],"reading":8,"stop":2,"t":3.5,"kind":"way"})",
      R"({"do":"miss","stop":1,"why":"no contact"})",
      R"({"do":"withdraw","number":1})",
      R"({"do":"show","id":"a"})",
      R"({"do":"gate","what":"pose","now":1,"stamp":1,"frame":"PSM1_base","position":[0,0,0],"quaternion":[1,0,0,0]})",
      R"({"do":"gate","what":"force","now":1,"stamp":1,"force":0.1})",
      R"({"do":"gate","what":"begin","stop":0,"now":1})",
      R"({"do":"gate","what":"permit","phase":"air","now":1,"frame":"PSM1_base","position":[0,0,0],"quaternion":[1,0,0,0]})",
      R"({"do":"gate","what":"watch","now":1})",
      R"({"do":"acknowledge","now":2})",
      R"({"do":"note","words":"mine"})"};
  std::string line =
      kSound[static_cast<std::size_t>(random.below(static_cast<int>(kSound.size())))];
  if (random.below(200) == 0) line = R"({"do":"close"})";
  if (random.below(20) == 0) line = scene;
  static const std::vector<std::string> kValues = {
      "null", "-1", "1e308", "1e999", "\"\\u0000\"", "[]", "{}", "true", "[[[[[[", "\"x\"", "0.5"};
  for (int change = random.below(4); change > 0; --change) {
    const std::size_t at = static_cast<std::size_t>(random.below(static_cast<int>(line.size())));
    switch (random.below(5)) {
      case 0:
        line[at] = static_cast<char>(random.below(256));
        break;
      case 1:
        line.erase(at, static_cast<std::size_t>(1 + random.below(8)));
        break;
      case 2:
        line.insert(at, line.substr(0, static_cast<std::size_t>(random.below(30))));
        break;
      default: {
        const std::size_t colon = line.find(':', at);
        if (colon == std::string::npos) break;
        const std::size_t end = line.find_first_of(",}", colon);
        line.replace(
            colon + 1, end == std::string::npos ? end : end - colon - 1,
            kValues[static_cast<std::size_t>(random.below(static_cast<int>(kValues.size())))]);
      }
    }
    if (line.empty()) line = " ";
  }
  std::ranges::replace(line, '\n', ' ');
  return line;
}

}  // namespace palpation::tool
