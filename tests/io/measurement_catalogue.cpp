#include "io/measurement_catalogue.h"

#include <utility>

namespace palpation::catalogue {
namespace {

using Cases = std::vector<MeasurementCase>;

constexpr const char* kHeader = "x,y,z,reading\n";
constexpr const char* kGood = "0.01,0.012,0,7\n";

std::string table(const std::string& rows) { return kHeader + rows; }

std::string with_noise(const std::string& rows) { return "x,y,z,reading,noise_variance\n" + rows; }

/// The row behind a good one, so that the line is not the first.
std::string second(const std::string& row) { return table(kGood + row + "\n"); }

/// Readings along a line, which vary like noise.
std::string several(int count, double offset = 0.0) {
  std::string rows;
  for (int i = 0; i < count; ++i)
    rows += "0.00" + std::to_string(1 + i % 9) + ",0.005,0," +
            std::to_string(offset + 7.0 + 0.01 * (i * 7 % 5)) + "\n";
  return rows;
}

void add_tables(Cases& cases) {
  const auto refused = [&](const std::string& name, const std::string& text,
                           std::vector<std::string> words) {
    cases.push_back({"CSV", name, text, std::move(words)});
  };
  const auto read = [&](const std::string& name, const std::string& text, int rows) {
    cases.push_back({"CSV", name, text, {}, rows, rows});
  };
  read("as few columns as possible", table(kGood), 1);
  read("a byte order mark", "\xEF\xBB\xBF" + table(kGood), 1);
  read("line ends of Windows", "x,y,z,reading\r\n0.01,0.012,0,7\r\n", 1);
  read("line ends of old Macs", "x,y,z,reading\r0.01,0.012,0,7\r", 1);
  read("quotes and blanks", "\"x\", y ,z,reading\n\"0.01\", 0.012 ,0, \"7\" \n\n", 1);
  read("columns in another order", "reading,z,y,x\n7,0,0.012,0.01\n", 1);
  read("columns that are not known", "x,y,z,who,reading\n0.01,0.012,0,\"Anna, M\xfcller\",7\n", 1);
  read("exponents and signs", table("+1e-2,.012,-0.0,7.\n"), 1);
  read("a direction of travel of any length",
       "x,y,z,reading,tx,ty,tz\n0.01,0.012,0,7,1e300,-1e300,0\n0.01,0.013,0,7,1e-320,0,0\n0.01,0."
       "014,0,7,0,0,0\n",
       3);

  refused("an empty file", "",
          {": the file is empty; a header line that names the columns is expected"});
  refused("blank lines", "\n\n", {": the file is empty"});
  refused("a last line without its end", "x,y,z,reading\n0.01,0.012,0,8",
          {":2: the last line has no line end, so it may have been cut short: if it is whole, end "
           "it with a newline"});
  refused("no header", "0.01,0.012,0,7\n",
          {":1: the header line, which names the columns, is missing"});
  refused("a column that is missing", "x,y,reading\n0,0,1\n",
          {":1: no column \"z\" among \"x, y, reading\""});
  refused("columns in capitals", "X,Y,Z,READING\n",
          {":1: no column \"x\" among \"X, Y, Z, READING\""});
  refused("a column twice", "x,y,z,reading,x\n0,0,0,1,0\n", {":1: column \"x\" appears twice"});
  refused("a column without a name", "x,y,z,,reading\n", {":1: a column has no name"});
  refused("semicolons and decimal commas", "x;y;z;reading\n0,01;0,012;0;7\n",
          {":1: the header has semicolons between its cells: commas are expected, and points in "
           "decimals"});
  refused("tabs", "x\ty\tz\treading\n0.01\t0.012\t0\t7\n",
          {":1: the header has tabs between its cells"});
  refused("decimal commas", table("0,01,0,012,0,0,7,0\n"),
          {":2: 8 cells, but the header names 4 columns (decimals take a point, not a comma)"});
  refused("a quoted decimal comma", second("\"0,01\",0.012,0,7"),
          {":3: column x: \"0,01\" is not a number: decimals take a point"});
  refused("a cell too few", second("0.01,0.012,7"),
          {":3: 3 cells, but the header names 4 columns"});
  refused("a cell too many", second("0.01,0.012,0,7,8"),
          {":3: 5 cells, but the header names 4 columns"});
  refused("one cell", second("7"), {":3: 1 cell, but the header names 4 columns"});
  refused("an empty cell", second("0.01,,0,7"), {":3: column y: \"\" must be a finite number"});
  refused("a number in hexadecimals", second("0.01,0.012,0,0x7"),
          {":3: column reading: \"0x7\" is not a number"});
  refused("a blank between thousands", second("0.01,0.012,0,1 000"),
          {":3: column reading: \"1 000\" is not a number"});
  refused("a unit behind the number", second("0.01,0.012,0,7 N"),
          {":3: column reading: \"7 N\" is not a number"});
  refused("a quote that does not end", second("0.01,0.012,0,\"7"),
          {":3: a quoted cell does not end on its line"});
  refused("text behind a quote", second("0.01,0.012,0,\"7\"8"),
          {":3: text behind the quoted cell \"7\""});
  refused(
      "UTF-16", std::string("\xff\xfex\0,\0", 6),
      {", byte 3: a NUL byte has no place in a text file (if this is UTF-16, save it as UTF-8)"});
  refused("64,000 columns",
          [] {
            std::string header = "c0";
            for (int i = 1; i < 64000; ++i) header += ",c" + std::to_string(i);
            return header + "\n";
          }(),
          {":1: a line of more than 65536 bytes"});
  refused("1025 columns", std::string(1024, ',') + "\n", {":1: more than 1024 columns"});
  refused("a line of 100,000 letters", second("0.01,0.012,0," + std::string(100000, '7')),
          {":3: a line of more than 65536 bytes"});
  refused("an unknown kind", "x,y,z,reading,kind\n0.01,0.012,0,7,poke\n",
          {":2: column kind: \"poke\" must be stop, way, missed or empty"});
  refused("a broken batch", "x,y,z,reading,batch\n0.01,0.012,0,7,1.5\n",
          {":2: column batch: \"1.5\" must be empty, or a whole number from 0 to 1000000"});
  refused("a negative batch", "x,y,z,reading,batch\n0.01,0.012,0,7,-1\n",
          {":2: column batch: \"-1\" must be empty"});
  refused("a batch beyond all", "x,y,z,reading,batch\n0.01,0.012,0,7,2147483647\n",
          {":2: column batch: \"2147483647\" must be empty"});
  refused("a direction of two numbers", "x,y,z,reading,tx,ty,tz\n0.01,0.012,0,7,1,,0\n",
          {":2: column ty: \"\" must be a finite number, or tx, ty and tz be empty"});
  refused("a direction of two columns", "x,y,z,reading,tx,ty\n0.01,0.012,0,7,1,0\n",
          {":2: there is no column tz: a direction needs tx, ty and tz"});
}

void add_values(Cases& cases) {
  const auto refused = [&](const std::string& row, const std::string& name, const std::string& text,
                           std::vector<std::string> words) {
    cases.push_back({row, name, text, std::move(words)});
  };
  refused("S01", "a reading that is no number", second("0.01,0.012,0,nan"),
          {":3: column reading: \"nan\" must be a finite number"});
  refused("S01", "an infinite reading", second("0.01,0.012,0,-Infinity"),
          {":3: column reading: \"-Infinity\" must be a finite number"});
  refused("S01", "a reading beyond all doubles", second("0.01,0.012,0,1e999"),
          {":3: column reading: \"1e999\" is too large for a double"});
  refused("S01", "a reading below all doubles", second("0.01,0.012,0,1e-400"),
          {":3: column reading: \"1e-400\" is too small for a double: write 0"});
  refused("S01", "a reading that is missing", second("0.01,0.012,0,"),
          {":3: column reading: \"\" must be a finite number"});
  refused("S01", "a position that is no number", second("0.01,nan,0,7"),
          {":3: column y: \"nan\" must be a finite number"});
  refused("S01", "an infinite position", second("0.01,0.012,inf,7"),
          {":3: column z: \"inf\" must be a finite number"});
  refused("S01", "a variance that is no number", with_noise("0.01,0.012,0,7,nan\n"),
          {":2: column noise_variance: \"nan\" must be a finite number"});
  refused("S01", "a negative variance", with_noise("0.01,0.012,0,7,-1\n"),
          {":2: column noise_variance: \"-1\" must be empty, 0, or 1e-60 to 1e60"});
  refused("S01", "a variance that is hardly a number", with_noise("0.01,0.012,0,7,1e-320\n"),
          {":2: column noise_variance: \"1e-320\" must be empty, 0,"});
  refused("S01", "a variance beyond use", with_noise("0.01,0.012,0,7,1e300\n"),
          {":2: column noise_variance: \"1e300\" must be empty, 0,"});
  refused("S01", "no reading, though set aside",
          "x,y,z,reading,set_aside\n0.01,0.012,0,nan,jammed\n",
          {":2: column reading: \"nan\" must be a finite number"});

  cases.push_back({"S02",
                   "readings that differ at one place",
                   table("0.01,0.012,0,7\n0.01,0.012,0,8\n"),
                   {},
                   2,
                   1});
  cases.push_back({"S02",
                   "with noise of their own",
                   with_noise("0.01,0.012,0,7,0.1\n0.01,0.012,0,8,0.4\n0.01,0.012,0,9,\n"),
                   {},
                   3,
                   1});
  refused("S03", "without noise",
          with_noise("0.01,0.012,0,7,0\n0.011,0.012,0,7,0\n0.01,0.012,0,8,0\n"),
          {":4: the reading 8 contradicts 7 in line 2: both are at one place and without noise"});
  refused("S03", "above each other", with_noise("0.01,0.012,0,7,0\n0.01,0.012,0.00001,8,0\n"),
          {":3: the reading 8 contradicts 7 in line 2"});
  cases.push_back({"S03",
                   "without noise, but alike",
                   with_noise("0.01,0.012,0,7,0\n0.01,0.012,0,7,0\n"),
                   {},
                   2,
                   1,
                   {"line 3 repeats line 2"}});
  cases.push_back(
      {"S03", "one without noise", with_noise("0.01,0.012,0,7,0\n0.01,0.012,0,8,1\n"), {}, 2, 1});
  cases.push_back(
      {"S03",
       "one set aside",
       "x,y,z,reading,noise_variance,set_aside\n0.01,0.012,0,7,0,\n0.01,0.012,0,8,0,jammed\n",
       {},
       2,
       1});
  cases.push_back(
      {"S05",
       "places a picometre apart",
       table("0.01,0.012,0,7\n0.010000000001,0.012,0,7\n"),
       {},
       2,
       1,
       {"line 3 repeats line 2",
        "1 position lies within a nanometre of an earlier one, and counts as the same place"}});
  cases.push_back({"S05",
                   "places two nanometres apart",
                   table("0.01,0.012,0,7\n0.010000002,0.012,0,7\n"),
                   {},
                   2,
                   2});
  refused("S05", "places a picometre apart, without noise",
          with_noise("0.01,0.012,0,7,0\n0.010000000001,0.012,0,8,0\n"),
          {":3: the reading 8 contradicts 7 in line 2"});

  cases.push_back({"S09",
                   "a gross outlier",
                   table(several(20) + "0.01,0.012,0,1e6\n"),
                   {},
                   21,
                   10,
                   {"1 reading stands more than 1000 times as far out as the middle half of all "
                    "readings is wide, in line 22 (1e+06)"}});
  cases.push_back({"S09",
                   "a gross outlier that is set aside",
                   "x,y,z,reading,set_aside\n0.01,0.012,0,7,\n0.01,0.012,0,1e6,slipped\n",
                   {},
                   2,
                   1});
  cases.push_back({"S09", "a tumour is none", table(several(20) + "0.01,0.012,0,9\n"), {}, 21, 10});
  cases.push_back({"S09",
                   "nor is the first difference",
                   table("0.01,0.012,0,7\n0.01,0.013,0,7\n0.01,0.014,0,9\n"),
                   {},
                   3,
                   3});
  cases.push_back({"S10",
                   "readings that are all alike",
                   table("0.01,0.012,0,7\n0.01,0.013,0,7\n0.01,0.014,0,7\n"),
                   {},
                   3,
                   3});
  cases.push_back({"S12", "an offset of a thousand million", table(several(9, 1e9)), {}, 9, 9});
  cases.push_back({"S12",
                   "readings as large as may be",
                   table("0.01,0.012,0,1e30\n0.01,0.013,0,-1e30\n"),
                   {},
                   2,
                   2});
  cases.push_back({"S12",
                   "a reading next to nothing",
                   table("0.01,0.012,0,1e-300\n0.01,0.013,0,1\n"),
                   {},
                   2,
                   2});
  refused("S12", "readings beyond use", second("0.01,0.012,0,1e300"),
          {":3: column reading: \"1e300\" must be at most 1e30 in size: write it in another unit"});
  refused("S12", "readings that hardly differ from nothing",
          table("0.01,0.012,0,1e-300\n0.01,0.013,0,2e-300\n"),
          {": column reading: the readings differ by 1e-300 at most; where they differ it must be "
           "by 1e-30 at least"});
  cases.push_back({"S13",
                   "some readings in another unit",
                   table(several(20) + "0.01,0.012,0,7000\n"),
                   {},
                   21,
                   10,
                   {"1 reading stands more than 1000 times as far out"}});
  cases.push_back(
      {"S14", "negative readings", table("0.01,0.012,0,-7\n0.01,0.013,0,-8\n"), {}, 2, 2});
  cases.push_back({"S15",
                   "the same row twice: a copy",
                   table("0.01,0.012,0,7\n0.01,0.012,0,7\n"),
                   {},
                   2,
                   1,
                   {"line 3 repeats line 2"}});
  cases.push_back({"S17",
                   "times order nothing: that they fall is told",
                   "t,x,y,z,reading\n9,0.01,0.012,0,7\n-1e99,0.01,0.013,0,7\nnan,0.01,0.014,0,7\n",
                   {},
                   3,
                   3,
                   {"t falls once, first in line 3"}});
  cases.push_back({"S19", "no row", table(""), {}, 0, 0});
  cases.push_back(
      {"S19", "no row that counts", "x,y,z,reading,set_aside\n0.01,0.012,0,7,jammed\n", {}, 1, 0});
}

void add_places(Cases& cases) {
  const auto refused = [&](const std::string& row, const std::string& name,
                           const std::string& position, std::vector<std::string> words) {
    cases.push_back({row, name, second(position + ",7"), std::move(words)});
  };
  const auto read = [&](const std::string& row, const std::string& name,
                        const std::string& position, std::vector<std::string> warnings = {}) {
    cases.push_back({row, name, second(position + ",7"), {}, 2, 2, std::move(warnings)});
  };
  read("S06", "a tenth of a millimetre above", "0.01,0.01,0.0001");
  read("S06", "a millimetre above", "0.01,0.01,0.001",
       {"1 of 2 positions lay off the surface, by up to 0.001 m in line 3, and were taken to its "
        "closest points"});
  read("S06", "five millimetres below", "0.01,0.01,-0.005",
       {"1 of 2 positions lay off the surface, by up to 0.005 m"});
  refused("S06", "more than five millimetres above", "0.01,0.01,0.006",
          {":3: the position (0.01, 0.01, 0.006) m is 0.006 m or more from the surface; at most "
           "0.005 m is allowed"});
  refused("S06", "a metre above", "0.01,0.01,1",
          {":3: the position (0.01, 0.01, 1) m is 1 m or more from the surface"});
  refused("S06", "in millimetres", "10,12,0",
          {":3: the position (10, 12, 0) m is", "(is it in millimetres? positions are metres)"});
  refused("S06", "beyond all squares", "1e300,0.01,0",
          {":3: the position (1e+300, 0.01, 0) m is 1e+300 m or more from the surface"});
  read("S07", "on the border", "0.02,0.01,0");
  read("S07", "on a corner", "0,0,0");
  read("S07", "a hair beside the border", "-0.0000001,0.01,0");
  read("S07", "a millimetre beside the border", "0.021,0.01,0",
       {"1 of 2 positions lay off the surface, by up to 0.001"});
  refused("S07", "more than a millimetre beside the border", "-0.0011,0.01,0",
          {":3: the position (-0.0011, 0.01, 0) m is 0.0011 m beside the border of the surface; at "
           "most 0.001 m is allowed"});
  refused("S07", "beside a corner and above it", "-0.001,-0.001,0.001",
          {":3: the position (-0.001, -0.001, 0.001) m is 0.00141", "m beside the border"});
  read("S08", "on the edge between two triangles", "0.005,0.005,0");
  read("S08", "on a vertex", "0.02,0.02,0");
}

}  // namespace

const std::vector<MeasurementCase>& measurement_cases() {
  static const Cases all = [] {
    Cases cases;
    add_tables(cases);
    add_values(cases);
    add_places(cases);
    return cases;
  }();
  return all;
}

const std::vector<MeasurementRowElsewhere>& measurement_rows_elsewhere() {
  static const std::vector<MeasurementRowElsewhere> rows = {
      {"S04",
       "ten thousand repeats are no file to print: measurement_belief_test.cpp counts the places "
       "and compares with the whole model"},
      {"S11",
       "a file has no clock, and rows of a scan rise and fall with the tissue: what drifts is not "
       "told from what differs"},
      {"S13",
       "there is no range of readings to configure: a slip in some rows is told as an outlier, one "
       "in all rows is another unit"},
      {"S14", "readings have any unit and any origin: negative ones are allowed"},
      {"S15",
       "rows have no identity: the same row twice is a copy, one that reads otherwise a touch of "
       "its own"},
      {"S16",
       "rows have no identity: their order does not change the answer, as "
       "measurement_belief_test.cpp shows"},
      {"S18", "a file has no session that could be closed"},
      {"S20", "a file names no mesh: positions that are not on this one are refused"},
  };
  return rows;
}

}  // namespace palpation::catalogue
