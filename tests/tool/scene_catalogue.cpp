#include "tool/scene_catalogue.h"

#include <map>

namespace palpation::catalogue {
namespace {

using Groups = std::map<std::string, std::string>;

/// A small scene that runs in a moment, with groups put in or replaced.
std::string scene(const Groups& groups = {}) {
  Groups all = {
      {"surface", R"({"plane": {"size_mm": [20, 20], "vertices": [6, 6]}})"},
      {"plan", R"({"initial": {"count": 5}, "batch": 3, "batches": 1})"},
      {"probe",
       R"({"noise": 0.05, "tumours": [{"shape": "disk", "centre_mm": [10, 10, 0], "radius_mm": 5}]})"}};
  for (const auto& [name, text] : groups) all[name] = text;
  std::string text = "{\n";
  for (const auto& [name, value] : all) {
    if (!value.empty()) text += (text.size() > 2 ? ",\n  \"" : "  \"") + name + "\": " + value;
  }
  return text + "\n}\n";
}

std::string with(const std::string& group, const std::string& value) {
  return scene({{group, value}});
}
std::string field(const std::string& members) { return with("field", "{" + members + "}"); }
std::string plan(const std::string& members) {
  return with("plan", R"({"initial": {"count": 5}, )" + members + "}");
}
std::string tumour(const std::string& shape) {
  return with("probe", R"({"tumours": [)" + shape + "]}");
}
std::string probe(const std::string& members) { return with("probe", "{" + members + "}"); }
std::string surface(const std::string& members) { return with("surface", "{" + members + "}"); }

std::string nested(int depth) { return std::string(static_cast<std::size_t>(depth), '['); }

using Cases = std::vector<SceneCase>;

void add_syntax(Cases& cases) {
  const auto add = [&](const std::string& row, const std::string& name, const std::string& text,
                       std::vector<std::string> words) {
    cases.push_back({row, name, text, std::move(words)});
  };
  add("C01", "an empty file", "", {": is empty"});
  add("C01", "blanks only", " \n\t", {": is empty"});
  add("C01", "no JSON", "surface: plane", {":1:1: not JSON", "invalid literal"});
  add("C01", "a trailing comma", "{\n  \"seed\": 1,\n}",
      {":3:1: not JSON", "expected string literal"});
  add("C01", "two values", "{} {}", {":1:4: not JSON", "expected end of input"});
  add("C01", "a comment", "{ // mine\n}", {":1:3: not JSON"});
  add("C01", "single quotes", "{'seed': 1}", {":1:2: not JSON"});
  add("C01", "no UTF-8", "{\"seed\": \"\xff\"}", {":1:11: not JSON", "ill-formed UTF-8"});
  add("C01", "UTF-16", std::string("\xff\xfe{\0}\0", 6), {":1:1: not JSON"});
  add("C01", "a NUL byte", std::string("{\"seed\"\0: 1}", 12), {":1:8: not JSON"});
  add("C01", "a list", "[]", {": is [], but must be a JSON object"});
  add("C01", "a number", "3", {": is 3, but must be a JSON object"});
  add("C01", "null", "null", {": is null, but must be a JSON object"});
  add("C01", "a byte order mark is welcome", "\xEF\xBB\xBF" + scene(), {});
  add("C01", "Windows line ends are welcome",
      "{\r\n\"surface\": {\"plane\": {\"size_mm\": [9, 9], \"vertices\": [3, 3]}}\r\n}\r\n", {});

  add("C02", "a key one letter short", plan(R"("batches": 1, "gama": 0.5)"),
      {": plan.gama: is not a key", "the nearest is plan.gamma"});
  add("C02", "a key in the wrong group", field(R"("batch": 3)"),
      {": field.batch: is not a key", "the nearest is plan.batch"});
  add("C02", "a key in no group", with("batch", "3"),
      {": batch: is not a key", "the nearest is plan.batch"});
  add("C02", "a group one letter off", with("plam", "{}"),
      {": plam: is not a key", "the nearest is plan"});
  add("C02", "a key of a group inside", plan(R"("batches": 1, "stop": {"expected_error": 1})"),
      {": plan.stop.expected_error: is not a key", "the nearest is plan.stop.expected_error_mm2"});
  add("C02", "a key of a tumour",
      tumour(R"({"shape": "disk", "centre_mm": [10, 10, 0], "radius": 3})"),
      {": probe.tumours[0].radius: is not a key of a disk; the nearest is radius_mm"});
  add("C02", "a key of the second tumour",
      tumour(
          R"({"shape": "disk", "centre_mm": [10, 10, 0], "radius_mm": 3}, {"shape": "disk", "centr_mm": [10, 10, 0], "radius_mm": 3})"),
      {": probe.tumours[1].centr_mm: is not a key of a disk; the nearest is centre_mm"});
  add("C02", "a path in one word", with("plan.batch", "3"),
      {": plan.batch: is written in one word", "\"plan\": {"});
  add("C02", "an empty key", with("", "3"), {": : is not a key"});
  add("C02", "a key of a million letters", with(std::string(1000000, 'x'), "3"),
      {"xxx...: is not a key"});

  add("C03", "a key twice", "{\"seed\": 1, \"seed\": 1}", {": seed: appears twice"});
  add("C03", "a key of a group twice", "{\"plan\": {\"batch\": 3, \"batch\": 4}}",
      {": plan.batch: appears twice"});
  add("C03", "a group twice", "{\"plan\": {\"batch\": 3}, \"plan\": {\"batches\": 4}}",
      {": plan: appears twice"});
  add("C03", "a key of a tumour twice",
      "{\"probe\": {\"tumours\": [{}, {\"shape\": \"disk\", \"shape\": \"disk\"}]}}",
      {": probe.tumours[1].shape: appears twice"});
  add("C03", "a key twice, spelled differently", "{\"seed\": 1, \"s\\u0065ed\": 2}",
      {": seed: appears twice"});

  add("C05", "NaN", field(R"("noise": NaN)"), {":2:22: not JSON", "invalid literal"});
  add("C05", "Infinity", field(R"("noise": Infinity)"), {":2:22: not JSON", "invalid literal"});
  add("C05", "-Infinity", field(R"("noise": -Infinity)"), {":2:23: not JSON"});
  add("C05", "a number beyond all doubles", field(R"("noise": 1e999)"),
      {":2:26: '1e999' is too large for a double"});
  add("C05", "a number below all doubles", field(R"("noise": 1e-999)"),
      {});  // it is 0, and 0 is allowed
  add("C05", "NaN as a text", field(R"("noise": "nan")"),
      {": field.noise: is \"nan\", but must be a number or learn"});

  add("C06", "lists in lists, 100,000 deep", nested(100000),
      {"[0]", ": is nested deeper than 32 levels"});
  add("C06", "lists in a value, 100,000 deep", with("seed", nested(100000)),
      {": seed[0]", ": is nested deeper than 32 levels"});
  add("C06", "a list of a million numbers",
      with(
          "seed", "[0" +
                      [] {
                        std::string zeros;
                        for (int i = 1; i < 1000000; ++i) zeros += ",0";
                        return zeros;
                      }() +
                      "]"),
      {": seed: is a long list, but must be a number"});
  add("C06", "a text of a million letters", with("seed", "\"" + std::string(1000000, 'x') + "\""),
      {": seed: is \"xxx", "xxx..., but must be"});
}

void add_types(Cases& cases) {
  const auto add = [&](const std::string& name, const std::string& text, const std::string& words) {
    cases.push_back({"C04", name, text, {words}});
  };
  add("a text for a number", plan(R"("gamma": "0.5")"),
      ": plan.gamma: is \"0.5\", but must be a number");
  add("true for a number", plan(R"("gamma": true)"), ": plan.gamma: is true, but must be a number");
  add("null for a number", plan(R"("gamma": null)"), ": plan.gamma: is null, but must be a number");
  add("a list for a number", plan(R"("gamma": [0.5])"),
      ": plan.gamma: is [0.5], but must be a number");
  add("an object for a number", plan(R"("gamma": {"is": 0.5})"),
      ": plan.gamma: is {\"is\":0.5}, but must be a number");
  add("a broken number for a whole one", plan(R"("batch": 1.5)"),
      ": plan.batch: is 1.5, but must be a whole number");
  add("a number for a truth", plan(R"("safe_start": 1)"),
      ": plan.safe_start: is 1, but must be true or false");
  add("a text for a truth", plan(R"("safe_start": "yes")"),
      ": plan.safe_start: is \"yes\", but must be true or false");
  add("a number for a word", plan(R"("acquisition": 3)"),
      ": plan.acquisition: is 3, but must be one of auto, ils-ucb, ucb, evr");
  add("an unknown word", field(R"("metric": "straight")"),
      ": field.metric: is \"straight\", but must be one of chart, ambient");
  add("a word of another case", field(R"("trend": "Zero")"),
      ": field.trend: is \"Zero\", but must be one of zero, constant");
  add("an unknown word for a number", field(R"("length_mm": "guess")"),
      ": field.length_mm: is \"guess\", but must be a number or learn");
  add("a number for a text", surface(R"("mesh": 3, "unit": "mm")"),
      ": surface.mesh: is 3, but must be a text");
  add("an empty text", surface(R"("mesh": "", "unit": "mm")"), ": surface.mesh: is empty");
  add("a text with a hidden end", surface(R"("mesh": "square.off\u0000.ply", "unit": "mm")"),
      ": surface.mesh: is \"square.off\\u0000.ply\", but must be a text without control "
      "characters");
  add("a number for a group", with("plan", "3"), ": plan: is 3, but must be an object");
  add("null for a group", with("plan", "null"), ": plan: is null, but must be an object");
  add("a list for a group", with("plan", "[]"), ": plan: is [], but must be an object");
  add("a number for a list", with("robot", R"({"from_tissue": 1})"),
      ": robot.from_tissue: is 1, but must be a list of 16 numbers");
  add("a short list", with("robot", R"({"from_tissue": [1, 2]})"),
      ": robot.from_tissue: has 2 members, but must have 16");
  add("null in a list", surface(R"("plane": {"size_mm": [20, null]})"),
      ": surface.plane.size_mm[1]: is null, but must be a number");
  add("a broken number in a list of whole ones",
      surface(R"("plane": {"size_mm": [20, 20], "vertices": [6, 6.5]})"),
      ": surface.plane.vertices[1]: is 6.5, but must be a whole number");
  add("an object for the tumours", probe(R"("tumours": {})"),
      ": probe.tumours: is {}, but must be a list of shapes");
  add("a number for a tumour", tumour("3"),
      ": probe.tumours[0]: must be an object with a \"shape\"");
  add("a tumour without a shape", tumour(R"({"radius_mm": 3})"),
      ": probe.tumours[0]: must be an object with a \"shape\"");
  add("a shape that is a number", tumour(R"({"shape": 3})"),
      ": probe.tumours[0].shape: is 3, but must be one of disk, horseshoe, polygon");
  add("an unknown shape", tumour(R"({"shape": "disc"})"),
      ": probe.tumours[0].shape: is \"disc\", but must be one of disk, horseshoe, polygon");
  add("a disk without a radius", tumour(R"({"shape": "disk", "centre_mm": [10, 10, 0]})"),
      ": probe.tumours[0].radius_mm: is missing: a disk needs it");
  add("a point of two numbers",
      tumour(R"({"shape": "disk", "centre_mm": [10, 10], "radius_mm": 3})"),
      ": probe.tumours[0].centre_mm: has 2 members, but must have 3");
  add("a corner of two numbers",
      tumour(R"({"shape": "polygon", "points_mm": [[5, 5, 0], [9, 5, 0], [9, 9]]})"),
      ": probe.tumours[0].points_mm[2]: has 2 members, but must have 3");
  add("a text in a corner",
      tumour(R"({"shape": "polygon", "points_mm": [[5, 5, 0], [9, "5", 0], [9, 9, 0]]})"),
      ": probe.tumours[0].points_mm[1][1]: is \"5\", but must be a number");
  add("101 tumours", tumour([] {
        std::string many = "0";
        for (int i = 1; i <= 100; ++i) many += ", 0";
        return many;
      }()),
      ": probe.tumours: has 101 shapes, but may have at most 100");
}

void add_field(Cases& cases) {
  const auto add = [&](const std::string& row, const std::string& name, const std::string& text,
                       std::vector<std::string> words) {
    cases.push_back({row, name, text, std::move(words)});
  };
  add("C07", "negative noise", field(R"("noise": -1)"),
      {": field.noise: is -1, but must be 0, or 1e-30 to 1e+30"});
  add("C07", "no noise", field(R"("noise": 0)"), {});
  add("C07", "negative zero", field(R"("noise": -0.0)"), {});
  add("C07", "noise so small that its square is 0", field(R"("noise": 1e-300)"),
      {": field.noise: is 1e-300, but must be 0, or 1e-30"});
  add("C07", "the least noise", field(R"("noise": 1e-30)"), {});
  add("C07", "noise that drowns everything: the answer is the prior's", field(R"("noise": 1e30)"),
      {});
  add("C07", "noise whose square is no double", field(R"("noise": 1e300)"),
      {": field.noise: is 1e+300, but must be 0, or 1e-30 to 1e+30"});
  add("C07", "noise told twice",
      field(R"("length_mm": 3, "signal_sd": 1, "noise": 1, "noise_to_signal": 0.1)"),
      {": field.noise_to_signal: stands in place of field.noise"});
  add("C07", "noise as a share of what is learned", field(R"("noise_to_signal": 0.1)"),
      {": field.noise_to_signal: needs a fixed field.length_mm and field.signal_sd"});
  add("C07", "a probe with negative noise", probe(R"("noise": -0.1)"),
      {": probe.noise: is -0.1, but must be 0 to 1000000"});

  add("C08", "no length", field(R"("length_mm": 0)"),
      {": field.length_mm: is 0, but must be 1e-06 to 1000000 mm"});
  add("C08", "a negative length", field(R"("length_mm": -3)"),
      {": field.length_mm: is -3, but must be 1e-06 to 1000000 mm"});
  add("C08", "a length that is hardly a number", field(R"("length_mm": 1e-300)"),
      {": field.length_mm: is 1e-300, but must be"});
  add("C08", "a length like no other", field(R"("length_mm": 1e300)"),
      {": field.length_mm: is 1e+300, but must be"});
  add("C08", "less than a millionth of the tissue", field(R"("length_mm": 1e-5)"),
      {": field.length_mm: is 1e-05, but must be a millionth to a million times the tissue's size, "
       "which is 28.28"});
  add("C08", "a millionth of the tissue", field(R"("length_mm": 3e-5)"), {});
  add("C08", "35,000 times the tissue", field(R"("length_mm": 1e6, "noise": 0.1)"), {});
  add("C08", "a period that is missing", field(R"("kernel": "periodic")"),
      {": field.period_mm: is needed here: period of the periodic kernel"});
  add("C08", "a periodic kernel in space",
      field(R"("kernel": "periodic", "period_mm": 9, "metric": "ambient")"),
      {": field.kernel: is \"periodic\", which needs field.metric chart"});
  cases.push_back({"C08",
                   "a period without effect",
                   field(R"("period_mm": 9)"),
                   {},
                   {},
                   {"field.period_mm: has no effect"}});

  add("C09", "no signal", field(R"("signal_sd": 0)"),
      {": field.signal_sd: is 0, but must be 1e-30 to 1e+30"});
  add("C09", "a negative signal", field(R"("signal_sd": -1)"),
      {": field.signal_sd: is -1, but must be 1e-30"});
  add("C09", "a negative doubt of the constant", field(R"("constant_sd": -1)"),
      {": field.constant_sd: is -1, but must be 0, or 1e-30"});
  cases.push_back({"C09",
                   "a doubt without effect",
                   field(R"("constant_sd": 1, "trend": "zero")"),
                   {},
                   {},
                   {"field.constant_sd: has no effect"}});

  add("C10", "gamma below 0", plan(R"("gamma": -1e-9)"),
      {": plan.gamma: is -1e-09, but must be 0 to 1"});
  add("C10", "gamma above 1", plan(R"("gamma": 1.0000001)"),
      {": plan.gamma: is 1.0000001, but must be 0 to 1"});
  add("C10", "gamma of 0: explore", plan(R"("gamma": 0, "batch": 3, "batches": 1)"), {});
  add("C10", "gamma of 1: exploit", plan(R"("gamma": 1, "batch": 3, "batches": 1)"), {});

  const auto level = [&](const std::string& name, const std::string& members,
                         std::vector<std::string> words) {
    cases.push_back({"C11", name, with("level", "{" + members + "}"), std::move(words)});
  };
  level("a fraction of 0", R"("fraction": 0)",
        {": level.fraction: is 0, but must be 1e-06 to 0.999999"});
  level("a fraction of 1", R"("fraction": 1)",
        {": level.fraction: is 1, but must be 1e-06 to 0.999999"});
  level("a negative fraction", R"("fraction": -0.5)", {": level.fraction: is -0.5, but must be"});
  level("a subnormal fraction", R"("fraction": 1e-320)",
        {": level.fraction: is 1e-320, but must be"});
  level("the least fraction", R"("fraction": 1e-6)", {});
  level("the greatest fraction", R"("fraction": 0.999999)", {});
  level("a known level that is missing", R"("estimate": "known")",
        {": level.value: is needed here"});
  level("a level beyond all readings", R"("estimate": "known", "value": 1e300)",
        {": level.value: is 1e+300, but must be -1e+30 to 1e+30"});
  cases.push_back({"C11",
                   "a level without effect",
                   with("level", R"({"estimate": "range", "value": 8})"),
                   {},
                   {},
                   {"level.value: has no effect, since level.estimate is range"}});
}

void add_domain(Cases& cases) {
  const auto add = [&](const std::string& row, const std::string& name, const std::string& text,
                       std::vector<std::string> words) {
    cases.push_back({row, name, text, std::move(words)});
  };
  add("C12", "no tissue", with("surface", ""),
      {": surface.mesh: is needed: the file of the tissue's mesh"});
  add("C12", "two tissues",
      surface(R"("mesh": "square.off", "unit": "mm", "plane": {"size_mm": [20, 20]})"),
      {": surface: has both a mesh and a plane"});
  add("C12", "a plane of no area", surface(R"("plane": {"size_mm": [20, 0]})"),
      {": surface.plane.size_mm[1]: is 0, but must be 0.01 to 2000 mm"});
  add("C12", "a plane smaller than tissue", surface(R"("plane": {"size_mm": [0.5, 0.9]})"),
      {": surface.plane.size_mm: is [0.5,0.9], but must be 1 mm at least along one side"});
  add("C12", "a thread of tissue",
      scene({{"surface", R"({"plane": {"size_mm": [2000, 0.01], "vertices": [30, 2]}})"},
             {"probe", ""}}),
      {});
  add("C12", "a plane of one vertex",
      surface(R"("plane": {"size_mm": [20, 20], "vertices": [1, 6]})"),
      {": surface.plane.vertices[0]: is 1, but must be 2 to 20000"});
  add("C12", "a plane of more vertices than memory",
      surface(R"("plane": {"size_mm": [20, 20], "vertices": [20000, 20000]})"),
      {": surface.plane.vertices: is [20000,20000], but must be at most 4 million in all"});
  add("C12", "a mesh that is not there", surface(R"("mesh": "gone.ply", "unit": "mm")"),
      {"gone.ply: cannot read: No such file"});
  add("C12", "a mesh that is a folder", surface(R"("mesh": ".", "unit": "mm")"),
      {": cannot read: is a folder"});
  add("C12", "a mesh that is none", surface(R"("mesh": "scene.json", "unit": "mm")"),
      {"scene.json: its content is none of OBJ, OFF"});
  add("C12", "a mesh without a face", surface(R"("mesh": "faceless.off", "unit": "mm")"),
      {"faceless.off", "no faces"});
  add("C12", "a mesh that is no surface", surface(R"("mesh": "fan.off", "unit": "mm")"),
      {"fan.off: edge between vertices 0 and 1"});
  add("C12", "a closed mesh", surface(R"("mesh": "closed.off", "unit": "mm")"),
      {": surface: the mesh is a closed surface", "surface.patch"});
  add("C12", "corners twice", surface(R"("mesh": "seam.off", "unit": "mm")"), {});
  add("C12", "corners twice, joined",
      scene({{"surface", R"({"mesh": "seam.off", "unit": "mm", "weld": true})"},
             {"plan", R"({"initial": {"count": 4}, "batches": 0})"}}),
      {});
  add("C12", "a patch without a radius",
      surface(R"("mesh": "square.off", "unit": "mm", "patch": {"centre_mm": [10, 10, 0]})"),
      {": surface.patch.radius_mm: is needed here"});
  add("C12", "a patch without a centre",
      surface(R"("mesh": "square.off", "unit": "mm", "patch": {"radius_mm": 5})"),
      {": surface.patch: has a radius but no centre_mm"});
  add("C12", "a patch without a mesh",
      surface(R"("patch": {"centre_mm": [10, 10, 0], "radius_mm": 5})"),
      {": surface.mesh: is needed"});
  add("C12", "a patch smaller than a triangle",
      surface(
          R"("plane": {"size_mm": [20, 20], "vertices": [6, 6]}, "patch": {"centre_mm": [10, 10, 0], "radius_mm": 0.1})"),
      {": surface.patch.radius_mm: is 0.1, but must be large enough for a triangle"});
  add("C12", "a patch in a box",
      scene(
          {{"surface",
            R"({"plane": {"size_mm": [20, 20], "vertices": [11, 11]}, "patch": {"box_mm": [3, 3, -1, 17, 17, 1]}})"},
           {"plan", R"({"initial": {"count": 4}, "batches": 0})"}}),
      {});
  add("C12", "a patch in a box without inside",
      surface(
          R"("plane": {"size_mm": [20, 20], "vertices": [6, 6]}, "patch": {"box_mm": [3, 3, 0, 17, 17, 0]})"),
      {": surface.patch.box_mm: is [3,3,0,17,17,0], but must be two corners"});
  add("C12", "a patch in a box beside the tissue",
      surface(
          R"("plane": {"size_mm": [20, 20], "vertices": [6, 6]}, "patch": {"box_mm": [3, 3, 5, 17, 17, 6]})"),
      {": surface.patch: leaves no triangle"});
  add("C12", "a patch that faces away",
      surface(
          R"("plane": {"size_mm": [20, 20], "vertices": [6, 6]}, "patch": {"facing": [0, 0, -1]})"),
      {": surface.patch: leaves no triangle"});
  add("C12", "a patch that faces nowhere",
      surface(
          R"("plane": {"size_mm": [20, 20], "vertices": [6, 6]}, "patch": {"facing": [0, 0, 0]})"),
      {": surface.patch.facing: must not be zero"});
  add("C12", "a patch larger than the tissue",
      surface(
          R"("plane": {"size_mm": [20, 20], "vertices": [6, 6]}, "patch": {"centre_mm": [10, 10, 0], "radius_mm": 1e6})"),
      {});
  add("C12", "triangles of no size",
      surface(R"("plane": {"size_mm": [20, 20], "vertices": [6, 6]}, "refine_mm": 0)"),
      {": surface.refine_mm: is 0, but must be 1e-06 to 1000000 mm"});
  add("C12", "more triangles than memory",
      surface(R"("plane": {"size_mm": [20, 20], "vertices": [6, 6]}, "refine_mm": 1e-6)"),
      {": surface.refine_mm: is 1e-06, but must be coarser: from 50 triangles with edges up to "
       "5.6568"});

  add("C13", "no touch in a batch", plan(R"("batch": 0)"),
      {": plan.batch: is 0, but must be 1 to 10000"});
  add("C13", "a negative batch", plan(R"("batch": -3)"),
      {": plan.batch: is -3, but must be 1 to 10000"});
  add("C13", "more touches than vertices", plan(R"("batch": 37)"),
      {": plan.batch: is 37, but must be at most 36, the vertices of the tissue"});
  add("C13", "as many touches as vertices", plan(R"("batch": 36, "batches": 1)"), {});
  add("C13", "more first touches than vertices", with("plan", R"({"initial": {"count": 37}})"),
      {": plan.initial.count: is 37, but must be at most 36, the vertices of the tissue"});
  add("C13", "defaults that are more than vertices",
      scene({{"plan", R"({"batches": 1})"},
             {"surface", R"({"plane": {"size_mm": [9, 9], "vertices": [3, 3]}})"}}),
      {});
  add("C14", "no batches", with("plan", R"({"initial": {"count": 5}, "batches": 0})"), {});
  add("C14", "no touch at all", with("plan", R"({"initial": {"count": 0}, "batches": 0})"), {});
  add("C14", "no first touches",
      with("plan", R"({"initial": {"count": 0}, "batch": 3, "batches": 2})"), {});

  add("C15", "a mesh without a unit", surface(R"("mesh": "square.off")"),
      {": surface.unit: is needed here"});
  add("C15", "an unknown unit", surface(R"("mesh": "square.off", "unit": "inch")"),
      {": surface.unit: is \"inch\", but must be one of mm, cm, m"});
  add("C15", "millimetres read as metres", surface(R"("mesh": "square.off", "unit": "m")"),
      {"square.off: read in m the mesh is 20 m long", "is its unit mm or cm?"});
  add("C15", "metres read as millimetres", surface(R"("mesh": "metres.off", "unit": "mm")"),
      {"metres.off: read in mm the mesh is 2e-05 m long", "is its unit m?"});
  add("C15", "the right unit", surface(R"("mesh": "square.off", "unit": "mm", "refine_mm": 5)"),
      {});
  cases.push_back({"C15",
                   "a unit of no mesh",
                   surface(R"("plane": {"size_mm": [20, 20], "vertices": [6, 6]}, "unit": "m")"),
                   {},
                   {},
                   {"surface.unit: has no effect"}});

  const auto robot = [&](const std::string& row, const std::string& name,
                         const std::string& members, std::vector<std::string> words) {
    cases.push_back({row, name, with("robot", "{" + members + "}"), std::move(words)});
  };
  const std::string rigid = ": robot.from_tissue: must be a rotation and a translation";
  robot("C16", "a mirrored frame", R"("from_tissue": [-1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1])",
        {rigid});
  robot("C16", "a frame in millimetres",
        R"("from_tissue": [1000,0,0,0, 0,1000,0,0, 0,0,1000,0, 0,0,0,1])", {rigid});
  robot("C16", "a frame of zeros", R"("from_tissue": [0,0,0,0, 0,0,0,0, 0,0,0,0, 0,0,0,0])",
        {rigid});
  robot("C16", "a frame at the end of the world",
        R"("from_tissue": [1,0,0,1e300, 0,1,0,0, 0,0,1,0, 0,0,0,1])",
        {": robot.from_tissue[3]: is 1e+300, but must be -1000000 to 1000000"});
  robot("C17", "a negative standoff", R"("standoff_mm": -1)",
        {": robot.standoff_mm: is -1, but must be 0 to 1000 mm"});
  robot("C17", "pressing out of the tissue", R"("indent_mm": -2)",
        {": robot.indent_mm: is -2, but must be 0 to 100 mm"});
  robot("C17", "pressing through the tissue", R"("indent_mm": 101)",
        {": robot.indent_mm: is 101, but must be 0 to 100 mm"});
  robot("C17", "not pressing at all", R"("indent_mm": 0, "standoff_mm": 0)", {});
  robot("C17", "a warning beyond the hold", R"("limits": {"warn_n": 6, "hold_n": 5})",
        {": robot.limits: contact_n 0.1, warn_n 6, hold_n 5 must rise"});

  add("C18", "a version to come", with("version", "2"),
      {": version: is 2, but this program reads version 1: it is older than the scene"});
  add("C18", "a version in between", with("version", "1.5"),
      {": version: is 1.5, but this program reads version 1"});
  add("C18", "a version before the first", with("version", "0"),
      {": version: is 0, but must be 1"});
  add("C18", "a version as a text", with("version", "\"1\""),
      {": version: is \"1\", but must be a number"});
  add("C18", "this version", with("version", "1"), {});
  add("C18", "no version: the first", scene(), {});
  add("C18", "a seed that is no double", with("seed", "9007199254740993"),
      {": seed: is 9007199254740993, but must be 0 to 9007199254740991"});
  add("C18", "a negative seed", with("seed", "-1"), {": seed: is -1, but must be 0 to"});
}

void add_tumours(Cases& cases) {
  const auto add = [&](const std::string& name, const std::string& shape,
                       std::vector<std::string> words, std::vector<std::string> warnings = {}) {
    cases.push_back({"C12", name, tumour(shape), std::move(words), {}, std::move(warnings)});
  };
  add("a disk off the tissue", R"({"shape": "disk", "centre_mm": [500, 500, 0], "radius_mm": 5})",
      {": probe.tumours[0].centre_mm: is [500,500,0], which lies 678.8 mm off the tissue",
       "at most 5 mm", "[0, 0, 0] to [20, 20, 0] mm"});
  add("a disk above the tissue", R"({"shape": "disk", "centre_mm": [10, 10, 6], "radius_mm": 5})",
      {": probe.tumours[0].centre_mm: is [10,10,6], which lies 6.0 mm off the tissue"});
  add("a disk beside the tissue, reaching into it",
      R"({"shape": "disk", "centre_mm": [-4, 10, 0], "radius_mm": 8})", {});
  add("a disk beside the tissue, not reaching it",
      R"({"shape": "disk", "centre_mm": [-4, 10, 0], "radius_mm": 3})", {},
      {"probe.tumours: no vertex of the tissue lies in one"});
  add("a disk between the vertices",
      R"({"shape": "disk", "centre_mm": [10, 10, 0], "radius_mm": 1e-6})", {},
      {"probe.tumours: no vertex of the tissue lies in one"});
  add("a disk larger than the tissue",
      R"({"shape": "disk", "centre_mm": [10, 10, 0], "radius_mm": 1000})", {},
      {"probe.tumours: all of the tissue lies in one"});
  add("a disk of no radius", R"({"shape": "disk", "centre_mm": [10, 10, 0], "radius_mm": 0})",
      {": probe.tumours[0].radius_mm: is 0, but must be 1e-06 to 1000000 mm"});
  add("a disk of negative radius",
      R"({"shape": "disk", "centre_mm": [10, 10, 0], "radius_mm": -5})",
      {": probe.tumours[0].radius_mm: is -5, but must be"});
  const std::string horseshoe =
      R"({"shape": "horseshoe", "centre_mm": [10, 10, 0], "arc_radius_mm": 5, )";
  add("a horseshoe of no width", horseshoe + R"("half_width_mm": 0})",
      {": probe.tumours[0].half_width_mm: is 0, but must be 1e-06 to 1000000 mm"});
  add("a horseshoe wider than its arc", horseshoe + R"("half_width_mm": 5})",
      {": probe.tumours[0].half_width_mm: is 5, but must be below arc_radius_mm, 5"});
  add("a horseshoe of no arc", horseshoe + R"("half_width_mm": 1, "arc_deg": 0})",
      {": probe.tumours[0].arc_deg: is 0, but must be 0.001 to 360 degrees"});
  add("a horseshoe all round", horseshoe + R"("half_width_mm": 1.5, "arc_deg": 360})", {});
  add("a horseshoe that looks up", horseshoe + R"("half_width_mm": 1.5, "facing": [0, 0, 1]})",
      {": probe.tumours[0].facing: must have a part along the surface"});
  add("a horseshoe that looks nowhere", horseshoe + R"("half_width_mm": 1.5, "facing": [0, 0, 0]})",
      {": probe.tumours[0].facing: must have a part along the surface"});
  const auto polygon = [&](const std::string& name, const std::string& points,
                           std::vector<std::string> words, std::vector<std::string> warnings = {}) {
    add(name, R"({"shape": "polygon", "points_mm": [)" + points + "]}", std::move(words),
        std::move(warnings));
  };
  polygon("a polygon of nothing", "",
          {": probe.tumours[0].points_mm: has 0 points, but must have at least 3"});
  polygon("a polygon of two points", "[5, 5, 0], [15, 15, 0]",
          {": probe.tumours[0].points_mm: has 2 points, but must have at least 3"});
  polygon("a polygon of one point thrice", "[5, 5, 0], [5, 5, 0], [5, 5, 0]",
          {": probe.tumours[0].points_mm: is an outline of 1 distinct points must have at least "
           "three"});
  polygon("a polygon that repeats its first point", "[5, 5, 0], [15, 5, 0], [15, 15, 0], [5, 5, 0]",
          {});
  polygon("a bow-tie", "[5, 5, 0], [15, 15, 0], [15, 5, 0], [5, 15, 0]",
          {": probe.tumours[0].points_mm: is an outline whose sides 1 and 3 meet"});
  polygon("a polygon that turns back", "[5, 5, 0], [15, 5, 0], [5, 5, 0], [15, 15, 0]",
          {": probe.tumours[0].points_mm: is an outline whose sides"});
  polygon("a polygon on one line", "[5, 5, 0], [10, 10, 0], [15, 15, 0]",
          {": probe.tumours[0].points_mm: is an outline whose sides"});
  polygon("a corner off the tissue", "[5, 5, 0], [15, 5, 0], [150, 15, 0]",
          {": probe.tumours[0].points_mm[2]: is [150,15,0], which lies 130.0 mm off the tissue"});
  cases.push_back({"C12",
                   "a tumour no stiffer than its surroundings",
                   probe(R"("low": 9, "high": 7)"),
                   {": probe.high: is 7, but must be above probe.low, which is 9"}});
  cases.push_back({"C12",
                   "a tumour as stiff as its surroundings",
                   probe(R"("low": 9)"),
                   {": probe.high: is 9.0, but must be above probe.low, which is 9"}});
  cases.push_back({"C12",
                   "a contrast below all digits",
                   probe(R"("low": 1e15, "high": 1000000000000000.125)"),
                   {", but must be more than 1000.0000000000001 above probe.low"}});
  cases.push_back({"C12",
                   "readings beyond all doubles' squares",
                   probe(R"("high": 1e300)"),
                   {": probe.high: is 1e+300, but must be -1e+30 to 1e+30"}});
  cases.push_back({"C12",
                   "a bias along nothing",
                   probe(R"("bias": 1, "bias_axis": [0, 0, 0])"),
                   {": probe.bias_axis: must not be zero"}});
  cases.push_back({"C12",
                   "a bias through the tissue",
                   probe(R"("bias": 1, "bias_axis": [0, 0, 1])"),
                   {": probe.bias_axis: must not be at a right angle"}});
}

void add_overrides(Cases& cases) {
  const auto add = [&](const std::string& row, const std::string& given,
                       std::vector<std::string> words) {
    cases.push_back({row, "--set " + given.substr(0, 40), scene(), std::move(words), {given}});
  };
  add("C01", "plan.batch", {"--set plan.batch: must have the form KEY=VALUE"});
  add("C01", "plan.batch=", {"--set plan.batch: has no value"});
  add("C02", "probe.tumours[0].radius_mm=3",
      {"--set probe.tumours[0].radius_mm: is a part of probe.tumours: a list is set as a whole"});
  add("C02", "surface.plane.vertices.0=3",
      {"--set surface.plane.vertices.0: is a part of surface.plane.vertices: a list is set as a "
       "whole"});
  add("C01", "=3", {"--set =3: must have the form KEY=VALUE"});
  add("C01", "", {"--set : must have the form KEY=VALUE"});
  add("C01", "probe.tumours=[{\"shape\": \"disk\"", {"--set probe.tumours:1:17: not JSON"});
  add("C02", "plan.bach=2",
      {"--set plan.bach: is not a key of a scene; the nearest is plan.batch"});
  add("C02", "plan=3",
      {"--set plan: is a group of keys: set one of them, such as plan.acquisition"});
  add("C02", "/plan/batch=3", {"--set /plan/batch: is not a key of a scene"});
  add("C02", std::string(100000, 'x') + "=3", {"xxx...: is not a key of a scene"});
  add("C04", "plan.batch=many", {"--set plan.batch: is \"many\", but must be a number"});
  add("C04", "plan.batch=\"3\"", {"--set plan.batch: is \"3\", but must be a number"});
  add("C04", "plan.batch=2.5", {"--set plan.batch: is 2.5, but must be a whole number"});
  add("C04", "plan.acquisition=\xff\xfe",
      {"--set plan.acquisition: is \"\\ufffd\\ufffd\", but must be one of"});
  add("C05", "plan.batch=1e999", {"--set plan.batch:1:5: '1e999' is too large for a double"});
  add("C05", "plan.gamma=nan", {"--set plan.gamma: is \"nan\", but must be a number"});
  add("C06", "plan.batch=" + nested(60000),
      {"--set plan.batch: [0]", ": is nested deeper than 32 levels"});
  add("C06", "plan.batch=" + nested(60000) + std::string(60000, ']'),
      {"--set plan.batch: [0]", ": is nested deeper than 32 levels"});
  cases.push_back({"C03",
                   "--set the same key twice",
                   scene(),
                   {"--set plan.batch: is given twice"},
                   {"plan.batch=2", "plan.batch=3"}});
  cases.push_back({"C04",
                   "--set a key of what is no group",
                   with("plan", "3"),
                   {": plan: is 3, but must be an object"},
                   {"plan.batch=2"}});
  cases.push_back({"C04",
                   "--set a key of what is no group further in",
                   with("plan", R"({"initial": []})"),
                   {": plan.initial: is [], but must be an object"},
                   {"plan.initial.count=2"}});
  cases.push_back({"C04",
                   "--set values of each kind",
                   scene(),
                   {},
                   {"plan.batch=2", "plan.acquisition=evr", "field.standardize=false",
                    "field.noise=0.1", "probe.tumours=[]"}});
  cases.push_back({"C04",
                   "--set a path without quotes",
                   with("surface", R"({"unit": "mm"})"),
                   {},
                   {"surface.mesh=./square.off", "surface.refine_mm=5"}});
}

}  // namespace

const std::vector<SceneCase>& scene_cases() {
  static const Cases all = [] {
    Cases cases;
    add_syntax(cases);
    add_types(cases);
    add_field(cases);
    add_domain(cases);
    add_tumours(cases);
    add_overrides(cases);
    return cases;
  }();
  return all;
}

const std::vector<SceneFile>& scene_files() {
  static const std::vector<SceneFile> files = {
      {"square.off", "OFF\n4 2 0\n0 0 0\n20 0 0\n20 20 0\n0 20 0\n3 0 1 2\n3 0 2 3\n"},
      {"metres.off", "OFF\n4 2 0\n0 0 0\n0.02 0 0\n0.02 0.02 0\n0 0.02 0\n3 0 1 2\n3 0 2 3\n"},
      {"faceless.off", "OFF\n3 0 0\n0 0 0\n20 0 0\n20 20 0\n"},
      {"fan.off",
       "OFF\n5 3 0\n0 0 0\n20 0 0\n20 20 0\n10 -9 0\n10 0 9\n3 0 1 2\n3 1 0 3\n3 0 1 4\n"},
      {"closed.off",
       "OFF\n4 4 0\n0 0 0\n20 0 0\n0 20 0\n0 0 20\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n"},
      {"seam.off",
       "OFF\n6 2 0\n0 0 0\n20 0 0\n20 20 0\n0 0 0\n20 20 0\n0 20 0\n3 0 1 2\n3 3 4 5\n"},
  };
  return files;
}

const std::vector<RowElsewhere>& scene_rows_elsewhere() {
  static const std::vector<RowElsewhere> rows = {
      {"C16",
       "a scene has no workspace box: what bounds the robot's poses is the tissue and "
       "robot.from_tissue, which must be rigid"},
      {"C17",
       "a scene has no limits of speed and force: how deep the probe presses and where it stands "
       "off are bounded instead"},
      {"C19",
       "no session outlives a run: every run reads its scene anew, and summary.json keeps all "
       "options that it used"},
  };
  return rows;
}

}  // namespace palpation::catalogue
