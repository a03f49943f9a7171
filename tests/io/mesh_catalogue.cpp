#include "io/mesh_catalogue.h"

#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <utility>

#include "io/mesh_seeds.h"

namespace palpation::catalogue {
namespace {

using Cases = std::vector<MeshCase>;

/// The text with one place of it changed, which must be there.
std::string changed(const std::string& text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  if (at == std::string::npos)
    throw std::logic_error("the catalogue's \"" + from + "\" is not there");
  return text.substr(0, at) + to + text.substr(at + from.size());
}

std::string changed_everywhere(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos;
       at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

std::string repeated(const std::string& text, int times) {
  std::string all;
  for (int i = 0; i < times; ++i) all += text;
  return all;
}

// The unit square in every format. OBJ: vertices in lines 1 to 4, faces in 5 and 6. OFF: counts in
// 2, vertices in 3 to 6, faces in 7 and 8. ASCII PLY: the header's elements in 3 and 7, its end in
// 9, vertices in 10 to 13, faces in 14 and 15. ASCII STL: facets from 2 and 9 on.
const std::string kVertices = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
const std::string kObj = obj_of(square());
const std::string kOff = off_of(square());
const std::string kPly = ply_of(square(), PlyEncoding::Ascii);
const std::string kLittle = ply_of(square(), PlyEncoding::Little);
const std::string kBig = ply_of(square(), PlyEncoding::Big);
const std::string kStl = ascii_stl_of(square());
const std::string kBinaryStl = binary_stl_of(square());
const std::string kVtp = vtp_of(square());
const std::string kVtpPoints = "0 0 0 1 0 0 1 1 0 0 1 0 ";

std::string stl_counting(std::uint32_t count) {
  return kBinaryStl.substr(0, 80) + bytes_of(count) + kBinaryStl.substr(84);
}

/// The square with a float of its first facet's second corner replaced.
std::string stl_with(float number) {
  std::string bytes = kBinaryStl;
  return bytes.replace(84 + 24 + 4, 4, bytes_of(number));
}

/// The body of the binary PLY begins behind the header: vertices of 24 bytes, faces of 13.
std::size_t body_of(const std::string& ply) { return ply.find("end_header\n") + 11; }

std::string ply_with(const std::string& ply, std::size_t offset, const std::string& bytes) {
  std::string all = ply;
  return all.replace(body_of(ply) + offset, bytes.size(), bytes);
}

std::string at_byte(std::size_t byte) { return ", byte " + std::to_string(byte); }

/// The byte where a text begins that is in the file once.
std::string at_byte(const std::string& file, const std::string& text) {
  return at_byte(file.find(text));
}

void add_files(Cases& cases) {
  const std::string mark = "\xEF\xBB\xBF";
  for (const std::string& extension : std::vector<std::string>{"obj", "off", "ply", "stl", "vtp"}) {
    cases.push_back(
        {"M02", "an empty file", "empty." + extension, "", Refused{"", {"empty", "no vertices"}}});
    cases.push_back({"M02", "a byte order mark and nothing else", "mark." + extension, mark,
                     Refused{"", {"empty", "no vertices"}}});
  }
  cases.push_back({"M02", "blanks only", "blank.obj", repeated(" \t\n", 50),
                   Refused{"", {"OBJ holds no vertices"}}});
  cases.push_back({"M02", "comments only", "comments.obj", "# nothing\n# here\n",
                   Refused{"", {"OBJ holds no vertices"}}});
  cases.push_back({"M02", "blanks only under another name", "blank.ply", repeated(" \n", 50),
                   Refused{"", {"none of OBJ, OFF, STL, PLY and VTP"}}});

  const std::string named = "named .obj but holds ";
  cases.push_back(
      {"M04", "OFF under the name of OBJ", "square.obj", kOff, Accepted{4, 2, {named + "OFF"}}});
  cases.push_back({"M04", "PLY under the name of OBJ", "square.obj", kLittle,
                   Accepted{4, 2, {named + "binary PLY"}}});
  cases.push_back({"M04", "binary STL under the name of OBJ", "square.obj", kBinaryStl,
                   Accepted{4, 2, {named + "binary STL"}}});
  cases.push_back({"M04", "ASCII STL under the name of OBJ", "square.obj", kStl,
                   Accepted{4, 2, {named + "ASCII STL"}}});
  cases.push_back(
      {"M04", "VTP under the name of OBJ", "square.obj", kVtp, Accepted{4, 2, {named + "VTP"}}});
  cases.push_back({"M04", "OBJ under the name of STL", "square.stl", kObj,
                   Accepted{4, 2, {"named .stl but holds OBJ"}}});
  cases.push_back({"M04", "a name that says nothing", "square.dat", kOff, Accepted{4, 2}});
  cases.push_back({"M04", "a shopping list", "list.txt", "shopping: milk, eggs\n",
                   Refused{"", {"none of OBJ, OFF, STL, PLY and VTP"}}});
  cases.push_back({"M04", "a picture under the name of PLY", "picture.ply",
                   "BM" + repeated("\x01\x7F", 50), Refused{"", {"none of OBJ"}}});
  cases.push_back({"M04", "a page of the web", "page.obj", "<html><body>404</body></html>",
                   Refused{at_byte(0), {"<VTKFile> is expected"}}});
  cases.push_back(
      {"M04", "gzip", "square.obj", "\x1F\x8B\x08" + kObj, Refused{at_byte(0), {"compressed"}}});
  cases.push_back(
      {"M04", "zip", "square.stl", "PK\x03\x04" + kObj, Refused{at_byte(0), {"compressed"}}});
  cases.push_back({"M04", "VTK's legacy format", "square.vtk",
                   "# vtk DataFile Version 3.0\nx\nASCII\n", Refused{":1", {"legacy"}}});
  cases.push_back({"M04", "OFF without its first word", "square.off", kOff.substr(4),
                   Refused{"", {"none of OBJ"}}});
}

void add_stl(Cases& cases) {
  cases.push_back({"M05", "binary whose title begins with solid", "a.stl",
                   binary_stl_of(square(), "solid from a careless writer"), Accepted{4, 2}});
  cases.push_back({"M05", "the same, cut short", "a.stl",
                   binary_stl_of(square(), "solid").substr(0, 150),
                   Refused{at_byte(80), {"2 facets make 184 bytes", "has 150"}}});
  cases.push_back({"M06", "binary without facets", "a.stl", binary_stl_of({}),
                   Refused{"", {"binary STL holds no"}}});
  cases.push_back({"M06", "84 bytes of zero", "a.stl", std::string(84, '\0'),
                   Refused{"", {"binary STL holds no"}}});
  cases.push_back({"M06", "ASCII without facets", "a.stl", "solid\nendsolid\n",
                   Refused{"", {"ASCII STL holds no"}}});
  cases.push_back({"M07", "count of 2^31", "a.stl", stl_counting(0x80000000u),
                   Refused{at_byte(80), {"2147483648 facets make 107374182484 bytes", "has 184"}}});
  cases.push_back({"M07", "count of 2^32 - 1", "a.stl", stl_counting(0xFFFFFFFFu),
                   Refused{at_byte(80), {"4294967295 facets", "has 184"}}});
  cases.push_back({"M07", "count of one too many", "a.stl", stl_counting(3),
                   Refused{at_byte(80), {"3 facets make 234 bytes", "has 184"}}});
  cases.push_back({"M08", "bytes of a vendor behind the facets", "a.stl", kBinaryStl + "vendor",
                   Refused{at_byte(80), {"2 facets make 184 bytes", "has 190", "cut off"}}});
  cases.push_back({"M08", "count of one too few", "a.stl", stl_counting(1),
                   Refused{at_byte(80), {"1 facets make 134 bytes", "has 184"}}});
  cases.push_back({"M08", "83 bytes", "a.stl", std::string(83, '\0'),
                   Refused{at_byte(83), {"header", "84 bytes"}}});

  const auto without = [](const std::string& line) { return changed(kStl, line + "\n", ""); };
  cases.push_back({"M09", "no endfacet", "a.stl", without("endfacet"),
                   Refused{":8", {"facet 0", "\"endfacet\" is expected", "\"facet\""}}});
  cases.push_back({"M09", "no endloop", "a.stl", without("endloop"),
                   Refused{":7", {"facet 0", "\"endloop\" is expected", "\"endfacet\""}}});
  cases.push_back({"M09", "no endsolid", "a.stl", without("endsolid s"),
                   Refused{":16", {"facet 1", "ends", "endsolid is expected"}}});
  cases.push_back({"M09", "end solid in two words", "a.stl", changed(kStl, "endsolid", "end solid"),
                   Refused{":16", {"\"endsolid\" is expected", "\"end\""}}});
  cases.push_back({"M09", "no outer loop", "a.stl", without("outer loop"),
                   Refused{":3", {"facet 0", "\"outer\" is expected", "\"vertex\""}}});
  cases.push_back({"M09", "no normal", "a.stl", changed(kStl, "normal 0 0 0", ""),
                   Refused{":3", {"facet 0", "\"normal\" is expected"}}});
  cases.push_back({"M09", "a normal of two numbers", "a.stl",
                   changed(kStl, "normal 0 0 0", "normal 0 0"),
                   Refused{":3", {"facet 0", "\"outer\"", "no number"}}});
  cases.push_back({"M09", "a colour between the facets", "a.stl",
                   changed(kStl, "endfacet\n", "endfacet\ncolor 1 0 0\n"),
                   Refused{":9", {"\"color\""}}});
  cases.push_back({"M10", "four vertices in a loop", "a.stl",
                   changed(kStl, "vertex 1 0 0\n", "vertex 1 0 0\nvertex 2 0 0\n"),
                   Refused{":7", {"facet 0", "\"endloop\" is expected"}}});
  cases.push_back({"M10", "two vertices in a loop", "a.stl", without("vertex 1 0 0"),
                   Refused{":6", {"facet 0", "\"vertex\" is expected", "\"endloop\""}}});

  // Oddities that the format allows.
  cases.push_back(
      {"M05", "words in capitals", "a.stl",
       changed_everywhere(changed_everywhere(kStl, "vertex", "VERTEX"), "facet", "FACET"),
       Accepted{4, 2}});
  cases.push_back({"M05", "no title, and blank lines at the top", "a.stl",
                   "\n\n " + changed_everywhere(kStl, " s\n", "\n"), Accepted{4, 2}});
  cases.push_back({"M05", "two solids", "a.stl",
                   kStl + changed_everywhere(kStl, "vertex ", "vertex 5"),
                   Accepted{8, 4, {"2 solids", "2 components"}}});
  cases.push_back({"M11", "a normal that is no number", "a.stl",
                   changed(kStl, "normal 0 0 0", "normal nan nan nan"), Accepted{4, 2}});
  cases.push_back({"M32", "normals against the order of corners, as text", "a.stl",
                   changed_everywhere(kStl, "normal 0 0 0", "normal 0 0 -1"),
                   Accepted{4, 2, {"2 facets have a normal"}}});
  std::string turned = kBinaryStl;
  turned.replace(84 + 8, 4, bytes_of(-1.0f));
  cases.push_back({"M32", "a normal against the order of corners, as bytes", "a.stl", turned,
                   Accepted{4, 2, {"1 facets have a normal"}}});
}

void add_coordinates(Cases& cases) {
  const double nan = std::numeric_limits<double>::quiet_NaN(),
               infinity = std::numeric_limits<double>::infinity();
  for (const std::string& word :
       std::vector<std::string>{"nan", "NaN", "inf", "-inf", "infinity", "-nan(ind)", "nan(123)"}) {
    const std::string value = "y = \"" + word + "\"";
    cases.push_back({"M11", word + " in OBJ", "a.obj",
                     changed(kObj, "v 1 1 0", "v 1 " + word + " 0"),
                     Refused{":3", {"vertex 3", value, "not finite"}}});
  }
  for (const std::string& word : std::vector<std::string>{"nan", "inf"}) {
    const std::string value = "y = \"" + word + "\"";
    cases.push_back({"M11", word + " in OFF", "a.off", changed(kOff, "1 1 0", "1 " + word + " 0"),
                     Refused{":5", {"vertex 2", value, "not finite"}}});
    cases.push_back({"M11", word + " in ASCII STL", "a.stl",
                     changed(kStl, "vertex 1 0 0", "vertex 1 " + word + " 0"),
                     Refused{":5", {"vertex 1", value, "not finite"}}});
    cases.push_back({"M11", word + " in ASCII PLY", "a.ply",
                     changed(kPly, "1 1 0", "1 " + word + " 0"),
                     Refused{":12", {"vertex 2", "y = " + word, "not finite"}}});
    cases.push_back(
        {"M11", word + " in VTP", "a.vtp", changed(kVtp, "1 1 0", "1 " + word + " 0"),
         Refused{at_byte(kVtp, "<DataArray"), {"vertex 2", "y = " + word, "not finite"}}});
  }
  cases.push_back(
      {"M11", "NaN in little-endian PLY", "a.ply", ply_with(kLittle, 2 * 24 + 8, bytes_of(nan)),
       Refused{at_byte(body_of(kLittle) + 2 * 24 + 8), {"vertex 2", "y = nan", "not finite"}}});
  cases.push_back(
      {"M11", "infinity in big-endian PLY", "a.ply",
       ply_with(kBig, 2 * 24 + 8, bytes_of(-infinity, true)),
       Refused{at_byte(body_of(kBig) + 2 * 24 + 8), {"vertex 2", "y = -inf", "not finite"}}});
  cases.push_back({"M11", "NaN in binary STL", "a.stl", stl_with(std::nanf("")),
                   Refused{at_byte(112), {"facet 0", "y = nan", "not finite"}}});
  cases.push_back({"M11", "infinity in binary STL", "a.stl", stl_with(static_cast<float>(infinity)),
                   Refused{at_byte(112), {"facet 0", "y = inf", "not finite"}}});
  Shape with_nan = square();
  with_nan.points[2][1] = nan;
  const std::string raw =
      vtp_of(with_nan, {.arrays = VtpStyle::Arrays::AppendedRaw, .compressed = true});
  cases.push_back({"M11", "NaN in compressed VTP", "a.vtp", raw,
                   Refused{at_byte(raw, "<DataArray"), {"vertex 2", "y = nan", "not finite"}}});

  for (const std::string& word : std::vector<std::string>{
           "1e400", "-1e400", "1.8e308", "1e99999999999999999999", "1" + std::string(400, '0')}) {
    const std::string start = "y = \"" + word.substr(0, 40);
    cases.push_back({"M12", word.substr(0, 30) + " in OBJ", "a.obj",
                     changed(kObj, "v 1 1 0", "v 1 " + word + " 0"),
                     Refused{":3", {"vertex 3", start, "too large for a double"}}});
  }
  const std::string small = "1 coordinates are too small for a double and were taken as 0";
  for (const std::string& word : std::vector<std::string>{
           "1e-400", "2e-324", "-1e-99999999999999999999", "0." + std::string(400, '0') + "1"}) {
    cases.push_back({"M12", word.substr(0, 30) + " in OBJ", "a.obj",
                     changed(kObj, "v 1 1 0", "v 1 1 " + word), Accepted{4, 2, {small}}});
  }
  const auto both = [&](const std::string& kind, const std::string& file, const std::string& text,
                        const std::string& from, const std::string& place,
                        const std::string& value) {
    cases.push_back({"M12", "1e400 in " + kind, file, changed(text, from, "1 1 1e400"),
                     Refused{place, {value + "\"1e400\"", "too large for a double"}}});
    cases.push_back({"M12", "1e-400 in " + kind, file, changed(text, from, "1 1 1e-400"),
                     Accepted{4, 2, {small}}});
  };
  both("OFF", "a.off", kOff, "1 1 0", ":5", "vertex 2: z = ");
  both("ASCII PLY", "a.ply", kPly, "1 1 0", ":12", "z = ");
  both("VTP", "a.vtp", kVtp, "1 1 0", at_byte(kVtp.find("1 1 0") + 4), "points, number 8: ");
  cases.push_back({"M12", "1e400 in ASCII STL", "a.stl", changed(kStl, "1 0 0", "1 0 1e400"),
                   Refused{":5", {"vertex 1", "z = \"1e400\"", "too large for a double"}}});
  for (const std::string& word :
       std::vector<std::string>{"4.9e-324", "-0", "0e999", "00001e-5", "1E+05", "+1", ".5", "5.",
                                std::string(400, '0') + "1"}) {
    cases.push_back({"M12", word.substr(0, 30) + " is a number", "a.obj",
                     changed(kObj, "v 1 1 0", "v 1 1 " + word), Accepted{4, 2}});
  }

  for (const std::string& word : std::vector<std::string>{
           "1,5", "1.2.3", "0x10", "1e", "1e+", "e5", "1d3", "1f", "1_000", ".", "-", "+", "--1",
           "+-1", "1.#INF", "1#", "\xD9\xA1", "1\xC2\xA0"}) {
    cases.push_back({"M13", word + " is no number", "a.obj",
                     changed(kObj, "v 1 1 0", "v 1 " + word + " 0"),
                     Refused{":3", {"vertex 3", "y = \"" + word + "\"", "not a number"}}});
  }
  cases.push_back({"M13", "a decimal comma in OFF", "a.off", changed(kOff, "1 1 0", "1,5 1 0"),
                   Refused{":5", {"vertex 2", "x = \"1,5\"", "not a number"}}});
  cases.push_back({"M13", "a decimal comma in ASCII STL", "a.stl",
                   changed(kStl, "1 0 0", "1,5 0 0"),
                   Refused{":5", {"vertex 1", "x = \"1,5\"", "not a number"}}});
  cases.push_back({"M13", "a decimal comma in ASCII PLY", "a.ply",
                   changed(kPly, "1 1 0", "1,5 1 0"),
                   Refused{":12", {"x = \"1,5\"", "not a number"}}});
  cases.push_back(
      {"M13", "a decimal comma in VTP", "a.vtp", changed(kVtp, "1 1 0", "1,5 1 0"),
       Refused{at_byte(kVtp, "1 1 0"), {"points, number 6", "\"1,5\"", "not a number"}}});

  cases.push_back({"M14", "two coordinates in OBJ", "a.obj", changed(kObj, "v 1 1 0", "v 1 1"),
                   Refused{":3", {"vertex 3", "2 coordinates, not 3"}}});
  cases.push_back({"M14", "no coordinates in OBJ", "a.obj", changed(kObj, "v 1 1 0", "v"),
                   Refused{":3", {"vertex 3", "0 coordinates, not 3"}}});
  cases.push_back({"M14", "two coordinates in OFF", "a.off", changed(kOff, "1 1 0", "1 1"),
                   Refused{":5", {"vertex 2", "2 coordinates, not 3"}}});
  cases.push_back({"M14", "coordinates on two lines in OFF", "a.off",
                   changed(kOff, "1 1 0", "1 1\n0"),
                   Refused{":5", {"vertex 2", "2 coordinates, not 3"}}});
  cases.push_back({"M14", "two coordinates in ASCII STL", "a.stl",
                   changed(kStl, "vertex 1 0 0", "vertex 1 0"),
                   Refused{":5", {"facet 0", "3 coordinates on its line"}}});
  cases.push_back({"M14", "two coordinates in ASCII PLY", "a.ply", changed(kPly, "1 1 0", "1 1"),
                   Refused{":12", {"the line ends", "z is expected"}}});
  cases.push_back(
      {"M14", "two coordinates in VTP", "a.vtp", changed(kVtp, "1 1 0", "1 1"),
       Refused{at_byte(kVtp, "<DataArray"), {"points", "21 characters cannot hold 12 numbers"}}});

  cases.push_back({"M15", "a weight and a colour in OBJ", "a.obj",
                   "v 0 0 0 1\nv 1 0 0 .5 .5 .5\nv 1 1 0 1 .5 .5 .5\nv 0 1 0\nf 1 2 3\nf 1 3 4\n",
                   Accepted{4, 2}});
  cases.push_back({"M15", "nine numbers in OBJ", "a.obj",
                   changed(kObj, "v 1 1 0", "v 1 1 0 4 5 6 7 8 9"),
                   Refused{":3", {"vertex 3", "more than 8 numbers"}}});
  cases.push_back({"M15", "two hundred thousand words in OBJ", "a.obj",
                   changed(kObj, "v 1 1 0", "v 1 1 0" + repeated(" 1", 200'000)),
                   Refused{":3", {"vertex 3", "more than 8 numbers"}}});
  cases.push_back({"M15", "a lost line end in OBJ", "a.obj", changed(kObj, "v 1 0 0\n", "v 1 0 0 "),
                   Refused{":2", {"vertex 2", "\"v\" behind its coordinates is no number"}}});
  cases.push_back({"M15", "a normal in OFF", "a.off",
                   "NOFF\n3 1 0\n0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0 0 0 1\n3 0 1 2\n",
                   Accepted{3, 1}});
  cases.push_back(
      {"M15", "colours in OFF", "a.off",
       "COFF\n3 1\n0 0 0 255 0 0 255\n1 0 0 255 0 0 255\n0 1 0 255 0 0 255\n3 0 1 2 0.5 0.5 0.5\n",
       Accepted{3, 1}});
  cases.push_back({"M15", "a word behind the corners in OFF", "a.off",
                   changed(kOff, "3 0 1 2", "3 0 1 2 red"),
                   Refused{":7", {"face 0", "\"red\"", "no number"}}});
  cases.push_back({"M15", "a lost line end in OFF", "a.off", changed(kOff, "1 0 0\n", "1 0 0 "),
                   Refused{":4", {"vertex 1 has 6 numbers", "those before it have 3"}}});
  cases.push_back({"M15", "numbers too many in a vertex of OFF", "a.off",
                   changed(kOff, "1 0 0", "1 0 0 1"),
                   Refused{":4", {"vertex 1 has 4 numbers", "those before it have 3"}}});
  cases.push_back({"M15", "thirteen numbers too many in OFF", "a.off",
                   changed(kOff, "1 0 0", "1 0 0" + repeated(" 1", 13)),
                   Refused{":4", {"vertex 1", "more than 12 numbers too many"}}});
  cases.push_back({"M15", "five numbers too many in a face of OFF", "a.off",
                   changed(kOff, "3 0 1 2", "3 0 1 2 1 1 1 1 1"),
                   Refused{":7", {"face 0", "more than 4 numbers too many"}}});
  cases.push_back({"M15", "four coordinates in OFF", "a.off", changed(kOff, "OFF", "4OFF"),
                   Refused{":1", {"\"4OFF\"", "three coordinates"}}});
  cases.push_back({"M15", "other properties, lists and elements in PLY", "a.ply",
                   "ply\nformat ascii 1.0\ncomment c\nelement vertex 3\nproperty uchar "
                   "red\nproperty float x\nproperty float y\nproperty "
                   "list uchar int tags\nproperty float z\n"
                   "obj_info o\nelement edge 1\nproperty list uchar int ends\nproperty float "
                   "width\nelement face 1\nproperty float "
                   "quality\nproperty list uchar uint vertex_index\nend_header\n"
                   "9 0 0 0 0\n9 1 0 2 5 6 0\n9 0 1 1 7 0\n2 0 1 0.5\n0.5 3 0 1 2\n",
                   Accepted{3, 1}});
  cases.push_back({"M15", "a fourth number in a line of PLY", "a.ply",
                   changed(kPly, "1 1 0", "1 1 0 5"),
                   Refused{":12", {"more numbers on the line"}}});
  cases.push_back({"M15", "a vertex and a half in a line of PLY", "a.ply",
                   changed(kPly, "1 1 0\n0 1 0", "1 1 0 0\n1 0"),
                   Refused{":12", {"more numbers on the line"}}});
}

void add_indices(Cases& cases) {
  const auto obj = [&](const std::string& row, const std::string& word, const std::string& rule) {
    cases.push_back({row, "index " + word + " in OBJ", "a.obj", kVertices + "f 1 2 " + word + "\n",
                     Refused{":5", {"face 1", "\"" + word + "\"", rule}}});
  };
  obj("M16", "0", "they count from 1");
  obj("M16", "2147483648", "out of range");
  obj("M16", "1e20", "not of the form");
  obj("M16", "99999999999999999999", "not of the form");
  obj("M16", "1.0", "not of the form");
  obj("M16", "3/x", "not of the form");
  obj("M16", "3/1/1/1", "not of the form");
  obj("M16", "/", "not of the form");
  obj("M16", "3;", "not of the form");
  obj("M16", "abc", "not of the form");
  obj("M17", "-5", "counts back beyond the first of the 4 vertices");
  obj("M17", "-9223372036854775808", "counts back beyond");
  cases.push_back({"M16", "index 5 in OBJ", "a.obj", kVertices + "f 1 2 5\n",
                   Refused{":5", {"face 1", "vertex index 5", "out of range 1 to 4"}}});
  cases.push_back({"M16", "index 2^31 - 1 in OBJ", "a.obj", kVertices + "f 1 2 2147483647\n",
                   Refused{":5", {"face 1", "vertex index 2147483647", "out of range 1 to 4"}}});
  cases.push_back({"M16", "two faces on one line of OBJ", "a.obj", kVertices + "f 1 2 3 f 1 3 4\n",
                   Refused{":5", {"face 1", "\"f\"", "not of the form"}}});
  for (const std::string& word : std::vector<std::string>{
           "4", "-1", "99", "2147483648", "99999999999999999999", "0.0", "1e20", "x"}) {
    cases.push_back(
        {"M16", "index " + word + " in OFF", "a.off", changed(kOff, "3 0 2 3", "3 0 2 " + word),
         Refused{":8", {"face 1", "vertex index \"" + word + "\"", "out of range 0 to 3"}}});
  }
  cases.push_back({"M16", "index 4 in ASCII PLY", "a.ply", changed(kPly, "3 0 2 3", "3 0 2 4"),
                   Refused{":15", {"face 1", "vertex index 4", "out of range 0 to 3"}}});
  cases.push_back({"M16", "index -1 in ASCII PLY", "a.ply", changed(kPly, "3 0 2 3", "3 0 2 -1"),
                   Refused{":15", {"face 1", "vertex index -1", "out of range 0 to 3"}}});
  for (const std::string& word :
       std::vector<std::string>{"2147483648", "99999999999999999999", "1e20", "1.5", "x"}) {
    cases.push_back(
        {"M16", "index " + word + " in ASCII PLY", "a.ply",
         changed(kPly, "3 0 2 3", "3 0 2 " + word),
         Refused{":15", {"vertex index = \"" + word + "\"", "whole number that fits its type"}}});
  }
  for (const std::int32_t index : {4, -1, std::numeric_limits<std::int32_t>::max(),
                                   std::numeric_limits<std::int32_t>::min()}) {
    const std::string value = "vertex index " + std::to_string(index);
    // A negative index is seen where it stands; one that is too large, once all vertices are there.
    const std::size_t face = body_of(kLittle) + 4 * 24 + 13, index_place = face + 9;
    cases.push_back({"M16", value + " in little-endian PLY", "a.ply",
                     ply_with(kLittle, 4 * 24 + 13 + 9, bytes_of(index)),
                     Refused{at_byte(index < 0 ? index_place : face),
                             {"face 1", value, "out of range 0 to 3"}}});
    const std::size_t big_face = body_of(kBig) + 4 * 24 + 13, big_index_place = big_face + 9;
    cases.push_back({"M16", value + " in big-endian PLY", "a.ply",
                     ply_with(kBig, 4 * 24 + 13 + 9, bytes_of(index, true)),
                     Refused{at_byte(index < 0 ? big_index_place : big_face),
                             {"face 1", value, "out of range 0 to 3"}}});
  }
  cases.push_back({"M16", "indices that are real numbers in PLY", "a.ply",
                   changed(kPly, "uchar int", "uchar float"),
                   Refused{":7", {"\"face\"", "list of whole numbers"}}});

  cases.push_back({"M17", "negative indices in OBJ", "a.obj", kVertices + "f -4 -3 -2\nf 1 -2 4\n",
                   Accepted{4, 2}});
  cases.push_back({"M17", "negative indices with textures and normals", "a.obj",
                   kVertices + "vt 0 0\nvn 0 0 1\nf -4/-1/-1 -3/1 -2//1\nf -4/ -2// -1\n",
                   Accepted{4, 2}});
  cases.push_back(
      {"M17", "negative indices before their vertices", "a.obj", "f -1 -2 -3\n" + kVertices,
       Refused{":1", {"face 1", "\"-1\"", "counts back beyond the first of the 0 vertices"}}});
  cases.push_back({"M17", "faces before their vertices", "a.obj", "f 1 2 3\nf 1 3 4\n" + kVertices,
                   Accepted{4, 2}});
  cases.push_back({"M17", "faces before their vertices in PLY", "a.ply",
                   "ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int "
                   "vertex_indices\nelement vertex 3\nproperty int "
                   "x\nproperty int y\nproperty int z\nend_header\n3 0 1 2\n0 0 0\n1 0 0\n0 1 0\n",
                   Accepted{3, 1}});
}

void add_counts(Cases& cases) {
  for (const std::string& word :
       std::vector<std::string>{"-4", "four", "4.0", "1e1", "0x4", "99999999999999999999"}) {
    cases.push_back({"M18", word + " vertices in OFF", "a.off",
                     changed(kOff, "4 2 0", word + " 2 0"),
                     Refused{":2", {"\"" + word + "\" is not a count of vertices"}}});
    cases.push_back({"M18", word + " faces in OFF", "a.off",
                     changed(kOff, "4 2 0", "4 " + word + " 0"),
                     Refused{":2", {"\"" + word + "\" is not a count of faces"}}});
    cases.push_back({"M18", word + " vertices in PLY", "a.ply",
                     changed(kPly, "vertex 4", "vertex " + word),
                     Refused{":3", {"\"" + word + "\" is not a count"}}});
    cases.push_back({"M18", word + " faces in PLY", "a.ply",
                     changed(kLittle, "face 2", "face " + word),
                     Refused{":7", {"\"" + word + "\" is not a count"}}});
    cases.push_back(
        {"M18", word + " points in VTP", "a.vtp",
         changed(kVtp, "Points=\"4\"", "Points=\"" + word + "\""),
         Refused{at_byte(kVtp, "<Piece"), {"NumberOfPoints = \"" + word + "\"", "whole number"}}});
    cases.push_back(
        {"M18", word + " polygons in VTP", "a.vtp",
         changed(kVtp, "Polys=\"2\"", "Polys=\"" + word + "\""),
         Refused{at_byte(kVtp, "<Piece"), {"NumberOfPolys = \"" + word + "\"", "whole number"}}});
  }
  cases.push_back({"M18", "a negative count of edges in OFF", "a.off",
                   changed(kOff, "4 2 0", "4 2 -1"),
                   Refused{":2", {"\"-1\" is not a count of edges"}}});
  cases.push_back(
      {"M18", "no count of edges in OFF", "a.off", changed(kOff, "4 2 0", "4 2"), Accepted{4, 2}});
  cases.push_back({"M18", "one count in OFF", "a.off", changed(kOff, "4 2 0", "4"),
                   Refused{":2", {"counts of vertices and faces are expected"}}});
  cases.push_back(
      {"M18", "counts on the first line of OFF, comments between", "a.off",
       "# c\nOFF 4 2 0 # c\n# c\n\n" + changed(kOff.substr(10), "1 0 0", "# c\n1 0 0 # c"),
       Accepted{4, 2}});
  cases.push_back({"M18", "all of OFF on one line", "a.off", changed_everywhere(kOff, "\n", " "),
                   Refused{":1", {"more than three counts"}}});
  cases.push_back(
      {"M18", "binary OFF", "a.off",
       "OFF BINARY\n" + bytes_of(std::int32_t{4}, true) + bytes_of(std::int32_t{2}, true),
       Refused{":1", {"binary OFF is not read"}}});

  for (const std::string& count : std::vector<std::string>{"5", "2147483648", "4294967300",
                                                           "10000000000", "9223372036854775807"}) {
    const std::string vertices = count == "5" ? "100" : count,
                      row = count == "2147483648" ? "M42" : "M19";
    cases.push_back({row, vertices + " vertices in OFF", "a.off",
                     changed(kOff, "4 2 0", vertices + " 2 0"),
                     Refused{":2", {vertices + " vertices do not fit", "bytes"}}});
    cases.push_back({row, vertices + " faces in OFF", "a.off",
                     changed(kOff, "4 2 0", "4 " + vertices + " 0"),
                     Refused{":2", {vertices + " faces do not fit", "bytes"}}});
    cases.push_back({row, vertices + " vertices in ASCII PLY", "a.ply",
                     changed(kPly, "vertex 4", "vertex " + vertices),
                     Refused{":3", {vertices + " of element \"vertex\" do not fit", "bytes"}}});
    cases.push_back({row, vertices + " vertices in binary PLY", "a.ply",
                     changed(kLittle, "vertex 4", "vertex " + vertices),
                     Refused{":3", {vertices + " of element \"vertex\" do not fit", "bytes"}}});
    cases.push_back({row, vertices + " faces in binary PLY", "a.ply",
                     changed(kBig, "face 2", "face " + vertices),
                     Refused{":7", {vertices + " of element \"face\" do not fit", "bytes"}}});
  }
  cases.push_back({"M19", "2^31 of an element without properties", "a.ply",
                   changed(kPly, "element face", "element nothing 2147483648\nelement face"),
                   Refused{":7", {"2147483648 of element \"nothing\""}}});
  cases.push_back({"M19", "a line too few in OFF", "a.off", changed(kOff, "3 0 2 3\n", ""),
                   Refused{at_byte(kOff.size() - 8), {"the file ends", "face 1 is expected"}}});
  cases.push_back({"M19", "a line too many in OFF", "a.off", kOff + "3 0 1 3\n",
                   Refused{":9", {"more lines", "counts"}}});
  cases.push_back({"M19", "a line too many in PLY", "a.ply", kPly + "3 0 1 3\n",
                   Refused{":16", {"more numbers than the header announces"}}});
  cases.push_back({"M19", "a byte too many in PLY", "a.ply", kLittle + "x",
                   Refused{at_byte(kLittle.size()), {"1 bytes more than the header announces"}}});
  for (const std::string& count : std::vector<std::string>{"3", "2147483647"}) {
    cases.push_back({"M19", count + " polygons in VTP", "a.vtp",
                     changed(kVtp, "Polys=\"2\"", "Polys=\"" + count + "\""),
                     Refused{at_byte(kVtp.rfind("<DataArray") + count.size() - 1),
                             {"offsets of Polys", "2 numbers, not " + count}}});
  }
  cases.push_back({"M19", "one polygon in VTP, where there are two", "a.vtp",
                   changed(kVtp, "Polys=\"2\"", "Polys=\"1\""),
                   Refused{at_byte(kVtp, "6 </DataArray>"),
                           {"offsets of Polys", "more numbers than the 1 expected"}}});

  for (const std::string& count :
       std::vector<std::string>{"-1", "2147483647", "255", "256", "x", "3.0"}) {
    const bool fits_type = count == "255";
    cases.push_back({"M20", "a list of " + count + " in ASCII PLY", "a.ply",
                     changed(kPly, "3 0 2 3", count + " 0 2 3"),
                     fits_type ? Refused{":15", {"of 255 numbers does not fit into"}}
                               : Refused{":15",
                                         {"length of a list = \"" + count + "\"",
                                          "whole number that fits its type"}}});
  }
  const std::size_t list = 4 * 24 + 13;
  cases.push_back({"M20", "a list of 255 in little-endian PLY", "a.ply",
                   ply_with(kLittle, list, "\xFF"),
                   Refused{at_byte(body_of(kLittle) + list),
                           {"\"vertex_indices\" of 255 numbers does not fit into the 12 bytes"}}});
  for (const std::int32_t count : {std::numeric_limits<std::int32_t>::max(), -1}) {
    const std::string wide = changed(changed(kLittle, "list uchar", "list int"), "face 2", "face 1")
                                 .substr(0, body_of(kLittle) - 2 + 4 * 24) +
                             bytes_of(count) + std::string(12, '\0');
    cases.push_back(
        {"M20", "a list of " + std::to_string(count) + " in binary PLY", "a.ply", wide,
         Refused{at_byte(wide.size() - 16),
                 {"of " + std::to_string(count) + " numbers does not fit into the 12 bytes"}}});
  }
}

void add_ply_headers(Cases& cases) {
  const auto refuse = [&](const std::string& name, const std::string& from, const std::string& to,
                          const std::string& place, std::vector<std::string> parts,
                          const std::string& row = "M21") {
    cases.push_back(
        {row, name, "a.ply", changed(kPly, from, to), Refused{place, std::move(parts)}});
  };
  refuse("an unknown type", "double y", "real y", ":5", {"\"real\" is no type"});
  refuse("a type of 64 bits", "double y", "int64 y", ":5", {"\"int64\" is no type"});
  refuse("no z", "property double z\n", "", ":3", {"\"vertex\"", "no number \"z\""});
  refuse("x as a list", "property double x", "property list uchar double x", ":3",
         {"\"vertex\"", "no number \"x\""});
  refuse("two properties y", "double z", "double y", ":6", {"\"y\"", "appears twice"});
  refuse("no format", "format ascii 1.0\n", "", ":8", {"no format line"});
  refuse("format 1.1", "ascii 1.0", "ascii 1.1", ":2", {"\"format <encoding> 1.0\""});
  refuse("an unknown encoding", "ascii 1.0", "utf8 1.0", ":2", {"\"utf8\" is no encoding"});
  refuse("two formats", "format ascii 1.0\n", "format ascii 1.0\nformat ascii 1.0\n", ":3",
         {"one line \"format"});
  refuse("no end", "end_header\n", "", ":9", {"\"0\" is no statement"});
  refuse("words behind the end", "end_header", "end_header of it", ":9", {"\"end_header\""});
  refuse("a property before all elements", "element vertex 4\n",
         "property int a\nelement vertex 4\n", ":3", {"before the first element"});
  refuse("two elements vertex", "element face", "element vertex 1\nproperty int x\nelement face",
         ":7", {"\"vertex\" appears twice"});
  refuse("two elements face", "end_header",
         "element face 0\nproperty list uchar int vertex_indices\nend_header", ":9",
         {"\"face\" appears twice"});
  refuse("a count that is a real number", "uchar int", "float int", ":8",
         {"count must be a whole number", "\"float\""});
  refuse("no list of corners", "property list uchar int vertex_indices\n", "", ":7",
         {"\"face\"", "\"vertex_indices\""});
  refuse("corners that are no list", "property list uchar int vertex_indices",
         "property int vertex_indices", ":7", {"\"face\"", "\"vertex_indices\""});
  refuse("corners twice", "vertex_indices\n",
         "vertex_indices\nproperty list uchar int vertex_index\n", ":7",
         {"both \"vertex_indices\" and \"vertex_index\""});
  refuse("strips of triangles", "element face 2",
         "element tristrips 1\nproperty list int int vertex_indices\nelement face 2", ":7",
         {"strips", "faces"});
  refuse("a statement that there is none of", "element face", "elephant face", ":7",
         {"\"elephant\" is no statement"});
  refuse("65 elements", "end_header",
         [] {
           std::string elements;
           for (int i = 0; i < 63; ++i) elements += "element e" + std::to_string(i) + " 0\n";
           return elements + "end_header";
         }(),
         ":71", {"more than 64 elements"});
  refuse("20,000 properties", "element face",
         [] {
           std::string properties;
           for (int i = 0; i < 20000; ++i)
             properties += "property float p" + std::to_string(i) + "\n";
           return properties + "element face";
         }(),
         ":260", {"more than 256 properties", "\"vertex\""});
  refuse("a name of 100 kB", "double z", "double z" + std::string(100'000, 'z'), ":6",
         {"more than 4096 bytes"});
  refuse("mixed line ends", "double x\n", "double x\r\n", ":4", {"line ends are mixed"});
  refuse("a NUL byte", "double z", std::string("double z\0", 9), ":6", {"NUL byte"});
  cases.push_back({"M21", "a header cut short", "a.ply", kPly.substr(0, 60),
                   Refused{":5", {"ends without a line \"end_header\""}}});
  cases.push_back({"M21", "the word ply alone", "a.ply", "ply",
                   Refused{":1", {"ends without a line \"end_header\""}}});
  cases.push_back({"M21", "comments everywhere and a blank behind ply", "a.ply",
                   changed_everywhere(changed(kPly, "ply\n", "ply \n"), "property",
                                      "comment c\nobj_info o\nproperty"),
                   Accepted{4, 2}});
  cases.push_back({"M21", "whole numbers as coordinates", "a.ply",
                   changed_everywhere(kPly, "double", "short"), Accepted{4, 2}});
  refuse("a fraction that is declared a whole number",
         "property double z\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n0 "
         "0 0",
         "property char z\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n0 0 "
         "0.5",
         ":10", {"z = \"0.5\"", "whole number that fits its type"}, "M16");
  refuse("300 in a byte",
         "property double z\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n0 "
         "0 0",
         "property uchar z\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n0 "
         "0 300",
         ":10", {"z = \"300\"", "whole number that fits its type"}, "M16");

  // Counts and indices of the other order are absurd.
  cases.push_back({"M22", "big-endian header, little-endian numbers", "a.ply",
                   changed(kLittle, "little", "big"),
                   Refused{at_byte(body_of(kBig) + 4 * 24),
                           {"face 0", "vertex index", "out of range 0 to 3"}}});
  cases.push_back({"M22", "little-endian header, big-endian numbers", "a.ply",
                   changed(kBig, "big", "little"),
                   Refused{at_byte(body_of(kLittle) + 4 * 24),
                           {"face 0", "vertex index", "out of range 0 to 3"}}});
  const std::string raw = vtp_of(square(), {.arrays = VtpStyle::Arrays::AppendedRaw});
  cases.push_back({"M22", "big-endian header, little-endian numbers in VTP", "a.vtp",
                   changed(raw, "LittleEndian", "BigEndian"),
                   Refused{at_byte(raw.find("\n_") - 1), {"bytes does not fit into"}}});
}

void add_faces(Cases& cases) {
  cases.push_back({"M23", "vertices without faces in OBJ", "a.obj", kVertices,
                   Refused{"", {"OBJ holds no faces"}}});
  cases.push_back({"M23", "points and lines without faces in OBJ", "a.obj",
                   kVertices + "p 1\nl 1 2\n", Refused{"", {"OBJ holds no faces"}}});
  cases.push_back({"M23", "faces without vertices in OBJ", "a.obj", "f 1 2 3\n",
                   Refused{"", {"OBJ holds no vertices"}}});
  cases.push_back({"M23", "vertices without faces in OFF", "a.off", "OFF\n1 0 0\n0 0 0\n",
                   Refused{"", {"OFF holds no faces"}}});
  cases.push_back(
      {"M23", "nothing in OFF", "a.off", "OFF\n0 0 0\n", Refused{"", {"OFF holds no vertices"}}});
  cases.push_back({"M23", "vertices without faces in PLY", "a.ply",
                   ply_of({square().points, {}}, PlyEncoding::Little),
                   Refused{"", {"PLY holds no faces"}}});
  cases.push_back({"M23", "nothing in PLY", "a.ply", ply_of({}, PlyEncoding::Ascii),
                   Refused{"", {"PLY holds no vertices"}}});
  cases.push_back({"M23", "vertices without faces in VTP", "a.vtp", vtp_of({square().points, {}}),
                   Refused{"", {"VTP holds no faces"}}});
  cases.push_back({"M23", "nothing in VTP", "a.vtp",
                   vtp_of({}, {.arrays = VtpStyle::Arrays::AppendedRaw, .compressed = true}),
                   Refused{"", {"VTP holds no vertices"}}});
  cases.push_back({"M23", "points, lines and faces in OBJ", "a.obj", kObj + "p 1\nl 1 2\n",
                   Accepted{4, 2, {"2 points, lines or free forms were left out"}}});

  for (int corners = 0; corners < 3; ++corners) {
    const std::string has = "has " + std::to_string(corners) + " corners", rule = "at least 3";
    const std::string list = std::string(" 1 2").substr(0, static_cast<std::size_t>(2 * corners)),
                      from_0 = std::string(" 0 1").substr(0, static_cast<std::size_t>(2 * corners));
    cases.push_back({"M24", has + " in OBJ", "a.obj", kObj + "f" + list + "\n",
                     Refused{":7", {"face 3", has, rule}}});
    cases.push_back({"M24", has + " in OFF", "a.off",
                     changed(kOff, "3 0 1 2", std::to_string(corners) + from_0),
                     Refused{":7", {"face 0", has, rule}}});
    cases.push_back({"M24", has + " in PLY", "a.ply",
                     changed(kPly, "3 0 1 2", std::to_string(corners) + from_0),
                     Refused{":14", {"face 0", has, rule}}});
    cases.push_back({"M24", has + " in VTP", "a.vtp",
                     changed(kVtp, "3 6 ", std::to_string(corners) + " 6 "),
                     Refused{"", {"face 0", has, rule}}});
  }
  cases.push_back({"M24", "a corner twice in OBJ", "a.obj", kObj + "f 1 2 1\n",
                   Refused{":7", {"face 3", "uses vertex 1 twice"}}});
  cases.push_back({"M24", "a corner twice in OFF", "a.off", changed(kOff, "3 0 1 2", "3 0 1 1"),
                   Refused{":7", {"face 0", "uses vertex 1 twice"}}});
  cases.push_back(
      {"M24", "a corner twice in PLY", "a.ply",
       ply_with(kLittle, 4 * 24 + 13 + 5, bytes_of(std::int32_t{3})),
       Refused{at_byte(body_of(kLittle) + 4 * 24 + 13), {"face 1", "uses vertex 3 twice"}}});
  cases.push_back({"M24", "a corner twice in VTP", "a.vtp",
                   changed(kVtp, "0 1 2 0 2 3", "0 1 2 0 3 3"),
                   Refused{"", {"face 1", "uses vertex 3 twice"}}});
  cases.push_back({"M24", "equal corners in ASCII STL", "a.stl",
                   changed(kStl, "vertex 1 0 0", "vertex 0 0 -0"),
                   Refused{":2", {"face 0", "uses vertex 0 twice"}}});
  cases.push_back({"M24", "equal corners in binary STL", "a.stl",
                   binary_stl_of({square().points, {{0, 1, 2}, {0, 3, 3}}}),
                   Refused{at_byte(134), {"face 1", "uses vertex 3 twice"}}});

  std::string circle, face = "f", round;
  for (int i = 1; i <= 257; ++i) {
    circle += "v " + std::to_string(std::cos(i * 0.024)) + " " +
              std::to_string(std::sin(i * 0.024)) + " 0\n";
    (i < 257 ? face : round) += " " + std::to_string(i);
  }
  cases.push_back({"M25", "a quad", "a.obj", kVertices + "f 1 2 3 4\n", Accepted{4, 2}});
  cases.push_back({"M25", "a polygon of 256 corners", "a.obj", circle + face + "\n",
                   Accepted{256, 254, {"1 vertices belong to no face"}}});
  cases.push_back({"M25", "a polygon of 257 corners", "a.obj", circle + face + round + "\n",
                   Refused{":258", {"face 1", "more than 256 corners"}}});
  cases.push_back({"M25", "a polygon of 600,000 corners in OBJ", "a.obj",
                   kVertices + "f" + repeated(" 1", 600'000) + "\n",
                   Refused{":5", {"face 1", "more than 256 corners"}}});
  cases.push_back({"M25", "a polygon of 600,000 corners in OFF", "a.off",
                   changed(kOff, "3 0 1 2", "600000" + repeated(" 1", 600'000)),
                   Refused{":7", {"face 0", "600000 corners", "at most 256"}}});
  cases.push_back({"M25", "a polygon of 600,000 corners in PLY", "a.ply",
                   changed(changed(kPly, "list uchar", "list int"), "3 0 1 2",
                           "600000" + repeated(" 1", 600'000)),
                   Refused{":14", {"face 0", "more than 256 corners"}}});
  cases.push_back({"M25", "an arrowhead, seen as a whole from two of its corners", "a.obj",
                   "v 2 -1 0\nv 0.5 0 0\nv 2 1 0\nv 0 0 0\nf 1 2 3 4\n", Accepted{4, 2}});
  cases.push_back({"M25", "a polygon that no corner sees as a whole", "a.obj",
                   "v 0 0 0\nv 6 0 0\nv 6 4 0\nv 5 4 0\nv 5 1 0\nv 1 1 0\nv 1 4 0\nv 0 4 0\nf 1 2 "
                   "3 4 5 6 7 8\n",
                   Refused{":9", {"face 1", "no fan of triangles covers"}}});
  cases.push_back({"M25", "a polygon in the shape of an 8", "a.obj",
                   "v 0 0 0\nv 1 1 0\nv 1 0 0\nv 0 1 0\nf 1 2 3 4\n",
                   Refused{":5", {"face 1", "no fan of triangles covers"}}});
  cases.push_back({"M25", "a polygon without area", "a.obj",
                   "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 3 0 0\nf 1 2 3 4\n",
                   Refused{":5", {"face 1", "no fan of triangles covers"}}});

  // A second square, apart from the first by its numbers only.
  const std::string seam =
      "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 0 -0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 4 5 6\n";
  cases.push_back(
      {"M26", "vertices at one place", "a.obj", seam,
       Accepted{6,
                2,
                {"2 components",
                 "2 vertices have the same coordinates as another, such as vertices 0 and 3"}}});
  cases.push_back({"M27", "vertices within 1e-12 of the extent", "a.obj",
                   kObj + "v 1 1e-13 0\nv 2 0 0\nv 2 1 0\nf 5 6 7\n",
                   Accepted{7,
                            3,
                            {"2 components",
                             "1 vertex has a near-duplicate within 1e-12 of the extent, such as "
                             "vertices 1 and 4"}}});
  cases.push_back(
      {"M28", "vertices of no face in OBJ", "a.obj",
       "v 9 9 9\n" + changed(kVertices, "v 0 0 0\n", "v 0 0 0\nv 9 9 9\n") + "f 2 4 5\nf 2 5 6\n",
       Accepted{4, 2, {"2 vertices belong to no face"}}});
  cases.push_back({"M28", "vertices of no face in PLY", "a.ply",
                   ply_of({square().points, {{0, 1, 2}}}, PlyEncoding::Big),
                   Accepted{3, 1, {"1 vertices belong to no face"}}});
  cases.push_back({"M28", "vertices of no face in VTP", "a.vtp",
                   vtp_of({square().points, {{0, 1, 2}}}),
                   Accepted{3, 1, {"1 vertices belong to no face"}}});
  for (const std::string& again : std::vector<std::string>{"1 2 3", "2 3 1", "3 2 1"}) {
    cases.push_back({"M29", "the face 1 2 3 again as " + again, "a.obj", kObj + "f " + again + "\n",
                     Refused{":7", {"face 3", "corners of face 1 again"}}});
  }
  cases.push_back({"M29", "a solid twice in STL", "a.stl", kStl + kStl,
                   Refused{":18", {"face 2", "corners of face 0 again"}}});
  cases.push_back({"M29", "a face twice in binary STL", "a.stl",
                   binary_stl_of({square().points, {{0, 1, 2}, {2, 0, 1}}}),
                   Refused{at_byte(134), {"face 1", "corners of face 0 again"}}});
  cases.push_back({"M29", "a face twice in VTP", "a.vtp",
                   vtp_of({square().points, {{0, 1, 2}, {2, 0, 1}}}),
                   Refused{"", {"face 1", "corners of face 0 again"}}});
}

void add_topology(Cases& cases) {
  cases.push_back(
      {"M30", "three faces on an edge", "a.obj", kObj + "v 0 0 1\nf 1 3 5\n",
       NoSurface{5,
                 3,
                 {"edge between vertices 0 and 2", "one or two triangles", "is in 3: 0, 1, 2"},
                 {"components"}}});
  cases.push_back({"M31", "two fans at a vertex", "a.obj",
                   "v 0 0 0\nv 1 0 0\nv 0 1 0\nv -1 0 0\nv 0 -1 0\nf 1 2 3\nf 1 4 5\n",
                   NoSurface{5, 2, {"vertex 0", "one fan", "of 2, only 1"}, {"2 components"}}});
  cases.push_back({"M32", "a face turned round", "a.obj",
                   kVertices + "v 2 0 0\nf 1 3 2\nf 1 3 4\nf 2 5 3\n",
                   Accepted{5, 3, {"1 triangle was turned round"}}});
  cases.push_back({"M32", "a closed surface inside out", "a.off",
                   off_of({tetrahedron().points, {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {0, 2, 3}}}),
                   Accepted{4, 4, {"faces that look inward"}}});
  // Five triangles in a ring: vertices i, i+1, i+2 modulo 5, which is the smallest strip with one
  // side.
  const std::string strip =
      "v 1 0 0\nv 0.3 0.9 0.2\nv -0.8 0.6 -0.1\nv -0.8 -0.6 0.3\nv 0.3 -0.9 -0.2\nf 1 2 3\nf 3 2 "
      "4\nf 3 4 5\nf 5 4 1\nf 5 1 2\n";
  cases.push_back({"M33", "a Moebius strip", "a.obj", strip,
                   NoSurface{5,
                             5,
                             {"edge between vertices", "opposite directions", "one side only"},
                             {"cannot be oriented"}}});
  cases.push_back({"M34", "two squares", "a.obj", kObj + "v 5 0 0\nv 6 0 0\nv 6 1 0\nf 5 6 7\n",
                   Accepted{7, 3, {"in 2 components"}}});
  cases.push_back(
      {"M34", "two pieces of VTP", "a.vtp",
       changed(kVtp, "</Piece>\n",
               "</Piece>\n" + changed(kVtp.substr(kVtp.find("<Piece"),
                                                  kVtp.find("</PolyData>") - kVtp.find("<Piece")),
                                      kVtpPoints, "5 0 0 6 0 0 6 1 0 5 1 0 ")),
       Accepted{8, 4, {"in 2 components"}}});
  cases.push_back({"M37", "a triangle without area", "a.obj", kObj + "v 2 0 0\nf 2 1 5\n",
                   NoSurface{5,
                             3,
                             {"triangle 2", "must have an area"},
                             {"1 triangles are slivers", "face 3, with 0 rad"}}});
  cases.push_back(
      {"M37", "a triangle with an edge of no length", "a.obj", kObj + "v 1 0 0\nf 2 1 5\n",
       NoSurface{
           5, 3, {"triangle 2", "zero length"}, {"same coordinates", "1 triangles are slivers"}}});
  cases.push_back({"M37", "a needle of 1e-7 rad", "a.obj", kObj + "v 0 -1e-7 0\nf 2 1 5\n",
                   Accepted{5, 3, {"1 triangles are slivers", "face 3, with 9.99"}}});
  cases.push_back(
      {"M37", "a cap of 1e-7 rad", "a.obj", kObj + "v 0.5 -1e-7 0\nf 2 1 5\n",
       Accepted{
           5,
           3,
           {"1 triangles are slivers, with an angle below 1e-6 rad; the worst is in face 3"}}});
  cases.push_back(
      {"M37", "a needle of 1e-5 rad", "a.obj", kObj + "v 0 -1e-5 0\nf 2 1 5\n", Accepted{5, 3}});
  cases.push_back({"M37", "all corners in one place", "a.obj",
                   "v 1 1 1\nv 1 1 1\nv 1 1 1\nf 1 2 3\n",
                   NoSurface{3, 1, {"triangle 0", "zero length"}, {"same coordinates"}}});
}

void add_text(Cases& cases) {
  const std::vector<std::pair<std::string, std::string>> texts = {
      {"a.obj", kObj}, {"a.off", kOff}, {"a.ply", kPly}, {"a.stl", kStl}, {"a.vtp", kVtp}};
  for (const std::string& end : std::vector<std::string>{"\r\n", "\r"}) {
    const std::string name = end == "\r" ? "CR alone" : "CRLF";
    for (const auto& [file, text] : texts) {
      cases.push_back({"M43", name + " as line end", file, changed_everywhere(text, "\n", end),
                       Accepted{4, 2}});
    }
    const std::size_t header = body_of(kLittle);
    cases.push_back(
        {"M43", name + " in the header of binary PLY", "a.ply",
         changed_everywhere(kLittle.substr(0, header), "\n", end) + kLittle.substr(header),
         Accepted{4, 2}});
  }
  cases.push_back({"M43", "a line of 5 MB in a comment", "a.obj",
                   "# " + std::string(5'000'000, 'x') + "\n" + kObj, Accepted{4, 2}});
  cases.push_back({"M43", "a word of 5 MB", "a.obj",
                   changed(kObj, "v 1 1 0", "v 1 1 " + std::string(5'000'000, 'x')),
                   Refused{":3", {"vertex 3", "z = \"xxxx", "not a number"}}});
  cases.push_back({"M43", "a number of 5 MB", "a.obj",
                   changed(kObj, "v 1 1 0", "v 1 1 0." + std::string(5'000'000, '0')),
                   Accepted{4, 2}});
  for (const auto& [file, text] : texts) {
    cases.push_back({"M43", "a byte order mark", file, "\xEF\xBB\xBF" + text, Accepted{4, 2}});
  }
  cases.push_back({"M43", "a NUL byte behind a byte order mark", "a.obj",
                   "\xEF\xBB\xBF" + kObj + std::string(1, '\0'),
                   Refused{at_byte(3 + kObj.size()), {"NUL byte"}}});
  cases.push_back({"M43", "a NUL byte in OBJ", "a.obj", kObj + std::string(1, '\0'),
                   Refused{at_byte(kObj.size()), {"NUL byte"}}});
  cases.push_back({"M43", "a NUL byte in OFF", "a.off", kOff + std::string(1, '\0'),
                   Refused{at_byte(kOff.size()), {"NUL byte"}}});
  cases.push_back({"M43", "a NUL byte in ASCII PLY", "a.ply", kPly + std::string(1, '\0'),
                   Refused{at_byte(kPly.size()), {"NUL byte"}}});
  cases.push_back({"M43", "a NUL byte in ASCII STL", "a.stl", kStl + std::string(1, '\0'),
                   Refused{at_byte(kStl.size()), {"NUL byte"}}});
  cases.push_back({"M43", "a NUL byte in VTP", "a.vtp",
                   changed(kVtp, "1 1 0", std::string("1 \0 0", 5)),
                   Refused{at_byte(kVtp.find("1 1 0") + 2), {"number 7", "not a number"}}});
  cases.push_back({"M43", "UTF-16", "a.obj", "\xFF\xFE" + kObj, Refused{at_byte(0), {"UTF-16"}}});
  cases.push_back({"M43", "Windows-1252 in a comment and a name", "a.obj",
                   "# caf\xE9\ng caf\xE9 \x80\n" + kObj, Accepted{4, 2}});
  cases.push_back({"M43", "Windows-1252 in a statement", "a.obj", kObj + "\xE9 1\n",
                   Refused{":7", {"is no statement of an OBJ file"}}});
  cases.push_back({"M43", "an end-of-file character of old", "a.obj", kObj + "\x1A",
                   Refused{":7", {"\"?\" is no statement"}}});
  cases.push_back({"M43", "tabs, form feeds and blanks", "a.obj",
                   changed_everywhere(changed_everywhere(kObj, " ", "\t \f"), "\n", " \t\v\n"),
                   Accepted{4, 2}});
  cases.push_back(
      {"M43", "lines that go on behind a backslash", "a.obj",
       "# made by C:\\tools\\\nv 0 0 \\\n0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 \\\n2 \\\n3\nf 1 3 4\n",
       Accepted{4, 2}});
  cases.push_back({"M09", "a facet behind endsolid", "a.stl",
                   kStl.substr(0, kStl.size() - 1) + " solid b facet normal 0 0 1 endsolid b\n",
                   Refused{":16", {"a facet stands where the name of the solid ends"}}});
  cases.push_back({"M43", "a name that ends with a backslash", "a.obj",
                   "mtllib C:\\scans\\\n" + kObj.substr(0, kObj.find("f ")) +
                       "g C:\\scans\\patient7\\\n" + kObj.substr(kObj.find("f ")),
                   Accepted{4, 2}});
  cases.push_back({"M43", "a backslash before the end", "a.obj", kObj + "f 1 2 \\",
                   Refused{":7", {"backslash", "the file ends"}}});
  cases.push_back({"M43", "no end of the last line", "a.obj", kObj.substr(0, kObj.size() - 1),
                   Accepted{4, 2, {"last line has no line end"}}});
  cases.push_back({"M43", "statements in capitals", "a.obj", "V 0 0 0\n" + kObj,
                   Refused{":1", {"\"V\" is no statement"}}});
  cases.push_back({"M43", "a statement that there is none of", "a.obj", kObj + "vertex 1 2 3\n",
                   Refused{":7", {"\"vertex\" is no statement"}}});
  cases.push_back({"M43", "a comment in a line", "a.obj",
                   kVertices + "f 1 2 3 # one\nf 1 3 4 #two\n", Accepted{4, 2}});
  cases.push_back({"M03", "counts at the top that are right", "a.obj",
                   "# Vertices: 4\n# Faces: 2\n" + kObj, Accepted{4, 2}});
  cases.push_back({"M03", "counts at the top that are not", "a.obj",
                   "# 4 vertices, 3 faces\n" + kObj,
                   Accepted{4, 2, {"says 3 faces, but there are 2"}}});
}

/// An array of the points, or of the cells.
std::string with_array(const std::string& where, const std::string& tag,
                       const std::string& numbers) {
  return changed(kVtp, "<Points>",
                 "<" + where + "><DataArray " + tag + " format=\"ascii\">" + numbers +
                     "</DataArray></" + where + "><Points>");
}

void add_vtp(Cases& cases) {
  const auto refuse = [&](const std::string& name, const std::string& from, const std::string& to,
                          const std::string& place, std::vector<std::string> parts) {
    cases.push_back(
        {"M45", name, "a.vtp", changed(kVtp, from, to), Refused{place, std::move(parts)}});
  };
  const std::string connectivity = at_byte(kVtp, "<DataArray type=\"Int64\" Name=\"connectivity\""),
                    offsets = at_byte(kVtp, "<DataArray type=\"Int64\" Name=\"offsets\"");
  for (const std::string& index :
       std::vector<std::string>{"4", "99", "-7", "1000000000000", "9223372036854775807"}) {
    refuse("index " + index, "0 1 2 0 2 3", "0 1 2 0 2 " + index, connectivity,
           {"cell 1 of Polys", "vertex index " + index, "out of range 0 to 3"});
  }
  const std::string last = at_byte(kVtp.find("0 1 2 0 2 3") + 10);
  refuse("index 1e20", "0 1 2 0 2 3", "0 1 2 0 2 99999999999999999999", last,
         {"connectivity of Polys, number 5", "\"99999999999999999999\"", "whole number"});
  refuse("index 1.5", "0 1 2 0 2 3", "0 1 2 0 2 1.5", last,
         {"connectivity of Polys, number 5", "\"1.5\"", "whole number"});
  refuse("offsets that decrease", "3 6 ", "6 3 ", offsets,
         {"offsets of Polys", "not decrease", "cell 1 is 3"});
  refuse("a negative offset", "3 6 ", "-3 6 ", offsets,
         {"offsets of Polys", "not decrease", "cell 0 is -3"});
  refuse("an offset past the end", "3 6 ", "3 600 ", connectivity,
         {"connectivity of Polys", "6 numbers, not 600"});
  refuse("an offset of 1e18", "3 6 ", "3 1000000000000000000 ", connectivity,
         {"connectivity of Polys", "6 numbers, not 1000000000000000000"});
  refuse("an offset before the end", "3 6 ", "3 5 ", "", {"face 1", "has 2 corners", "at least 3"});
  refuse("corners behind the last offset", "0 1 2 0 2 3 ", "0 1 2 0 2 3 1 ",
         at_byte(kVtp.find("0 1 2 0 2 3") + 12),
         {"connectivity of Polys", "more numbers than the 6 expected"});
  refuse("two offsets missing", "3 6 ", "", offsets, {"offsets of Polys", "0 numbers, not 2"});
  refuse("a count of 1e10", "Points=\"4\"", "Points=\"10000000000\"", at_byte(kVtp, "<Piece"),
         {"NumberOfPoints = \"10000000000\"", "whole number from 0 to 2147483647"});
  refuse("a count of 2^31 - 1", "Points=\"4\"", "Points=\"2147483647\"", at_byte(kVtp, "<Piece"),
         {"more than 2147483646 points"});
  refuse("a count of 10^9", "Points=\"4\"", "Points=\"1000000000\"",
         at_byte(kVtp.find("<DataArray") + 9), {"points", "cannot hold 3000000000 numbers"});
  refuse("one point too few", "Points=\"4\"", "Points=\"3\"", at_byte(kVtp.find(kVtpPoints) + 18),
         {"points, number 9", "more numbers than the 9 expected"});
  for (const std::string& components :
       std::vector<std::string>{"2", "0", "4", "2000000000", "-3", "three"}) {
    const bool known = components.size() == 1;
    refuse(components + " components", "Components=\"3\"", "Components=\"" + components + "\"",
           at_byte(kVtp, "<DataArray"),
           known ? std::vector<std::string>{"three components, not " + components}
                 : std::vector<std::string>{"NumberOfComponents = \"" + components + "\"",
                                            "whole number from 0 to 4096"});
  }
  refuse("no components", "NumberOfComponents=\"3\"", "", at_byte(kVtp, "<DataArray"),
         {"three components, not 1"});
  refuse("another type of file", "type=\"PolyData\"", "type=\"UnstructuredGrid\"",
         at_byte(kVtp, "<VTKFile"), {"\"UnstructuredGrid\"", "only \"PolyData\" is read"});
  refuse("a version to come", "version=\"1.0\" byte", "version=\"99.0\" byte",
         at_byte(kVtp, "<VTKFile"), {"version \"99.0\"", "not known"});
  refuse("an unknown byte order", "LittleEndian", "MiddleEndian", at_byte(kVtp, "<VTKFile"),
         {"\"MiddleEndian\"", "LittleEndian or BigEndian"});
  refuse("sizes of 16 bits", "UInt64\"", "UInt16\"", at_byte(kVtp, "<VTKFile"),
         {"header_type \"UInt16\"", "UInt32 or UInt64"});
  refuse("an unknown compressor", "header_type", "compressor=\"vtkZipDrive\" header_type",
         at_byte(kVtp, "<VTKFile"), {"compressor \"vtkZipDrive\"", "not known"});
  refuse("no points", "<Points>", "<Pints>", at_byte(kVtp.find("</Points>") - 1),
         {"must be </Pints>"});
  refuse("no polygons", "<Polys>", "<Pollys>", at_byte(kVtp.find("</Polys>") + 1),
         {"must be </Pollys>"});
  cases.push_back(
      {"M45", "no element of the points", "a.vtp", changed_everywhere(kVtp, "Points>", "Pints>"),
       Refused{at_byte(kVtp, "<Piece"), {"4 points are announced", "no element <Points>"}}});
  cases.push_back({"M45", "no element of the polygons", "a.vtp",
                   changed_everywhere(kVtp, "Polys>", "Pollys>"),
                   Refused{at_byte(kVtp, "<Piece"), {"2 Polys are announced", "no arrays"}}});
  cases.push_back({"M45", "no PolyData", "a.vtp",
                   changed_everywhere(kVtp, "PolyData>", "PollyData>"),
                   Refused{at_byte(kVtp, "<VTKFile"), {"no element <PolyData>"}}});
  refuse("connectivity under another name", "\"connectivity\"", "\"conn\"", connectivity,
         {"<Polys>", "\"connectivity\"", "not \"conn\""});
  refuse("connectivity of real numbers", "type=\"Int64\" Name=\"connectivity\"",
         "type=\"Float64\" Name=\"connectivity\"", connectivity,
         {"connectivity of Polys", "whole numbers"});
  refuse("points that are texts", "type=\"Float64\"", "type=\"String\"",
         at_byte(kVtp, "<DataArray"), {"points", "must be numbers"});
  refuse("an unknown type", "type=\"Float64\"", "type=\"Complex\"", at_byte(kVtp, "<DataArray"),
         {"\"Complex\" is no type"});
  refuse("an unknown format", "format=\"ascii\"", "format=\"askii\"", at_byte(kVtp, "<DataArray"),
         {"format must be ascii, binary, or appended"});
  refuse("an offset without appended data", "format=\"ascii\"", "format=\"appended\" offset=\"0\"",
         at_byte(kVtp, "<DataArray"), {"points", "no appended data"});
  refuse("a second piece of PolyData", "</PolyData>", "</PolyData><PolyData></PolyData>",
         at_byte(kVtp.find("</PolyData>") + 11), {"second element <PolyData>"});
  refuse("an attribute twice", "version=\"1.0\" byte", "type=\"PolyData\" byte",
         at_byte(kVtp, "version=\"1.0\" byte"), {"attribute \"type\" appears twice"});
  refuse("an attribute without quotes", "\"PolyData\"", "PolyData", at_byte(kVtp, "type="),
         {"name=\"value\""});
  refuse(
      "a cell type without end", "</Polys>", "",
      at_byte(kVtp, "</Polys>\n</Piece>").substr(0, 7) + std::to_string(kVtp.find("</Polys>") + 1),
      {"must be </Polys>"});
  refuse("an entity of one's own", "\"PolyData\"", "\"&poly;\"",
         at_byte(kVtp.find("\"PolyData\"") + 1), {"entities"});
  refuse("CDATA", kVtpPoints, "<![CDATA[" + kVtpPoints + "]]>", at_byte(kVtp, kVtpPoints),
         {"CDATA"});
  cases.push_back({"M45", "something behind the end", "a.vtp", kVtp + "junk",
                   Refused{at_byte(kVtp.size()), {"follows the end"}}});
  cases.push_back({"M45", "an entity bomb", "a.vtp",
                   "<?xml version=\"1.0\"?><!DOCTYPE b [<!ENTITY a \"aaaaaaaaaa\"><!ENTITY b "
                   "\"&a;&a;&a;&a;&a;&a;&a;&a;\">]><VTKFile>&b;</VTKFile>",
                   Refused{at_byte(21), {"entities"}}});
  cases.push_back({"M45", "a hundred thousand elements in each other", "a.vtp",
                   "<VTKFile type=\"PolyData\">" + repeated("<a>", 100'000) +
                       repeated("</a>", 100'000) + "</VTKFile>",
                   Refused{at_byte(25 + 31 * 3), {"nested deeper than 32"}}});
  cases.push_back({"M45", "20,000 pieces", "a.vtp",
                   "<VTKFile type=\"PolyData\"><PolyData>" + repeated("<Piece/>", 20'000) +
                       "</PolyData></VTKFile>",
                   Refused{at_byte(35 + 8 * 10'000), {"more than 10000 pieces"}}});
  cases.push_back({"M45", "a hundred thousand elements in a row", "a.vtp",
                   "<VTKFile type=\"PolyData\">" + repeated("<a/>", 100'000) + "</VTKFile>",
                   Refused{at_byte(0), {"no element <PolyData>"}}});
  cases.push_back({"M45", "a hundred attributes", "a.vtp",
                   "<VTKFile " +
                       [] {
                         std::string attributes;
                         for (int i = 0; i < 100; ++i)
                           attributes += "a" + std::to_string(i) + "=\"\" ";
                         return attributes;
                       }() +
                       ">",
                   Refused{at_byte(9 + 10 * 6 + 54 * 7), {"more than 64 attributes"}}});

  using Arrays = VtpStyle::Arrays;
  const std::string raw = vtp_of(square(), {.arrays = Arrays::AppendedRaw});
  cases.push_back(
      {"M45", "an appended offset past the end", "a.vtp",
       changed(raw, "offset=\"0\"", "offset=\"1000000\""),
       Refused{at_byte(raw, "<DataArray"), {"points", "offset 1000000 points behind the"}}});
  cases.push_back({"M45", "an appended offset amid an array", "a.vtp",
                   changed(raw, "offset=\"0\"", "offset=\"1\""),
                   Refused{at_byte(raw, "<DataArray"), {"points", "0 bytes, but 12 numbers"}}});
  cases.push_back({"M45", "a negative appended offset", "a.vtp",
                   changed(raw, "offset=\"0\"", "offset=\"-1\""),
                   Refused{at_byte(raw, "<DataArray"), {"offset = \"-1\"", "whole number"}}});
  cases.push_back(
      {"M45", "the appended bytes of another array", "a.vtp",
       changed(raw, "offset=\"0\"", "offset=\"104\""),
       Refused{at_byte(raw, "<DataArray"), {"points", "48 bytes, but 12 numbers", "96"}}});
  cases.push_back({"M45", "appended data without their mark", "a.vtp", changed(raw, "\n_", "\n+"),
                   Refused{at_byte(raw.find("\n_") + 1), {"must begin with \"_\""}}});
  cases.push_back({"M45", "appended data in an unknown encoding", "a.vtp",
                   changed(raw, "\"raw\"", "\"hex\""),
                   Refused{at_byte(raw, "<AppendedData"), {"encoding \"hex\"", "raw or base64"}}});
  cases.push_back({"M45", "an offset and no appended format", "a.vtp",
                   changed(kVtp, "format=\"ascii\"", "format=\"ascii\" offset=\"0\""),
                   Refused{at_byte(kVtp, "<DataArray"), {"appended with an offset"}}});
  const std::string base64 = vtp_of(square(), {.arrays = Arrays::Base64, .wide_header = false});
  const std::size_t body = base64.find("YAAAA");  // 96 bytes of points: their size in base64
  cases.push_back({"M45", "a size larger than its text", "a.vtp",
                   std::string(base64).replace(body, 4, "////"),
                   Refused{at_byte(body), {"a size of", "does not fit into"}}});
  cases.push_back({"M45", "a size smaller than its text", "a.vtp",
                   std::string(base64).replace(body, 4, "SAAA"),
                   Refused{at_byte(body), {"more than the array's sizes announce"}}});
  cases.push_back({"M45", "characters that are no base64", "a.vtp",
                   std::string(base64).replace(body + 40, 1, "*"),
                   Refused{at_byte(body), {"no base64"}}});
  const std::string packed =
      vtp_of(square(), {.arrays = Arrays::AppendedRaw, .compressed = true, .wide_header = false});
  const std::size_t blocks = packed.find("\n_") + 2;
  const auto with_word = [&](std::size_t index, std::uint32_t word) {
    return std::string(packed).replace(blocks + 4 * index, 4, bytes_of(word));
  };
  cases.push_back({"M45", "2^32 - 1 blocks", "a.vtp", with_word(0, 0xFFFFFFFFu),
                   Refused{at_byte(blocks), {"4294967295 blocks"}}});
  cases.push_back({"M45", "no block, but a last one", "a.vtp", with_word(0, 0),
                   Refused{at_byte(blocks), {"0 blocks", "the last of 32"}}});
  cases.push_back({"M45", "blocks of 2^31 bytes", "a.vtp", with_word(1, 0x80000000u),
                   Refused{at_byte(blocks), {"blocks of 2147483648 bytes"}}});
  cases.push_back(
      {"M45", "blocks of 2^30 bytes", "a.vtp", with_word(1, 0x40000000u),
       Refused{at_byte(packed, "<DataArray"), {"points", "1073741856 bytes, but 12 numbers"}}});
  cases.push_back({"M45", "a last block larger than the others", "a.vtp", with_word(2, 65),
                   Refused{at_byte(blocks), {"the last of 65"}}});
  cases.push_back({"M45", "a packed block larger than the file", "a.vtp", with_word(3, 0x7FFFFFFFu),
                   Refused{at_byte(blocks), {"a block of 2147483647 bytes does not fit"}}});
  cases.push_back({"M45", "a damaged packed block", "a.vtp",
                   std::string(packed).replace(blocks + 20 + 30, 1, "?"),
                   Refused{at_byte(blocks), {"block 0", "damaged"}}});
  cases.push_back(
      {"M45", "strips, points and lines", "a.vtp",
       changed(
           changed(
               kVtp, "NumberOfPolys=\"2\"",
               "NumberOfPolys=\"1\" NumberOfStrips=\"1\" NumberOfVerts=\"1\" NumberOfLines=\"1\""),
           kVtp.substr(kVtp.find("<Polys>"), kVtp.find("</Polys>") + 8 - kVtp.find("<Polys>")),
           [] {
             const auto cells = [](const std::string& kind, const std::string& corners,
                                   const std::string& ends) {
               return "<" + kind + "><DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">" +
                      ends +
                      "</DataArray><DataArray type=\"UInt8\" Name=\"connectivity\" "
                      "format=\"ascii\">" +
                      corners + "</DataArray></" + kind + ">";
             };
             return cells("Verts", "0", "1") + cells("Lines", "0 1", "2") +
                    cells("Strips", "0 1 3", "3") + cells("Polys", "1 2 3", "3");
           }()),
       Accepted{4, 2, {"2 cells are points or lines and were left out"}}});
  const auto strips = [](const std::string& corners, const std::string& end) {
    return changed(
        changed(changed(changed(changed(kVtp, "NumberOfPolys=\"2\"", "NumberOfStrips=\"1\""),
                                "<Polys>", "<Strips>"),
                        "</Polys>", "</Strips>"),
                "0 1 2 0 2 3", corners),
        "3 6 ", end);
  };
  cases.push_back(
      {"M25", "a strip of triangles in VTP", "a.vtp", strips("0 1 3 2", "4"), Accepted{4, 2}});
  cases.push_back({"M24", "a strip of two corners in VTP", "a.vtp", strips("0 1", "2"),
                   Refused{"", {"strip of 2 corners", "at least 3"}}});
  cases.push_back(
      {"M45", "names with the entities of XML, a comment, keys of information", "a.vtp",
       changed(with_array("PointData", "type=\"Float32\" Name=\"a &amp; b &lt; &quot;c&quot;\"",
                          "1 2 3 4<InformationKey name=\"k\" location=\"l\" length=\"1\"><Value "
                          "index=\"0\"> 7 </Value></InformationKey>"),
               "<Points>", "<!-- made < by & hand --><Points>"),
       Accepted{4, 2}});
}

void add_arrays(Cases& cases) {
  const std::string named = "type=\"Float64\" Name=\"stiffness\"";
  const auto refuse = [&](const std::string& name, const std::string& where, const std::string& tag,
                          const std::string& numbers, std::size_t word,
                          std::vector<std::string> parts) {
    const std::string file = with_array(where, tag, numbers);
    const std::size_t place =
        word == 0 ? file.find("<DataArray") : file.find(numbers + "</DataArray>") + word;
    cases.push_back({"M46", name, "a.vtp", file, Refused{at_byte(place), std::move(parts)}});
  };
  refuse("an array of the points that is too short", "PointData", named, "1 2 3", 0,
         {"\"stiffness\" of the points", "3 numbers, not 4"});
  refuse("an array of the points that is too long", "PointData", named, "1 2 3 4 5", 8,
         {"\"stiffness\" of the points", "more numbers than the 4 expected"});
  refuse("an array of the cells that is too short", "CellData", named, "1", 0,
         {"\"stiffness\" of the cells", "1 numbers, not 2"});
  refuse("an array of the cells that is too long", "CellData", named, "1 2 3", 4,
         {"\"stiffness\" of the cells", "more numbers than the 2 expected"});
  refuse("words in an array of numbers", "PointData", named, "1 soft 3 4", 2,
         {"\"stiffness\" of the points, number 1", "\"soft\" is not a number"});
  refuse("fractions in an array of whole numbers", "PointData", "type=\"Int32\" Name=\"stiffness\"",
         "1 2 3 4.5", 6, {"\"stiffness\" of the points, number 3", "\"4.5\"", "whole number"});
  refuse("an array without name", "PointData", "type=\"Float64\"", "1 2 3 4", 0,
         {"array of the points", "no name"});
  refuse("an array with an empty name", "CellData", "type=\"Float64\" Name=\"\"", "1 2", 0,
         {"array of the cells", "no name"});
  refuse("an array of an unknown type", "PointData", "type=\"Complex\" Name=\"stiffness\"",
         "1 2 3 4", 0, {"\"stiffness\"", "\"Complex\" is no type"});
  refuse("an array without type", "PointData", "Name=\"stiffness\"", "1 2 3 4", 0,
         {"\"stiffness\"", "\"\" is no type"});
  refuse("an array without components", "PointData", named + " NumberOfComponents=\"0\"", "1 2 3 4",
         0, {"\"stiffness\" of the points", "no components"});
  refuse("too few texts", "PointData", "type=\"String\" Name=\"names\"", "65 0 66 0 67 0", 0,
         {"\"names\" of the points", "3 texts, not 4"});
  refuse("a text without end", "CellData", "type=\"String\" Name=\"names\"", "65 0 66 0 67", 0,
         {"\"names\" of the cells", "2 texts, not 2"});
  refuse("a bit that is none", "CellData", "type=\"Bit\" Name=\"hard\"", "1 2", 2,
         {"\"hard\" of the cells, number 1", "\"2\"", "fits the array's type"});
  const std::string short_raw =
      changed(vtp_of(square(), {.arrays = VtpStyle::Arrays::AppendedRaw}), "<Points>",
              "<PointData><DataArray type=\"Float64\" Name=\"stiffness\" format=\"appended\" "
              "offset=\"104\"/></PointData><Points>");
  cases.push_back({"M46", "an appended array that is too long", "a.vtp", short_raw,
                   Refused{at_byte(short_raw, "<DataArray"),
                           {"\"stiffness\" of the points", "48 bytes, but 4 numbers", "32"}}});
  cases.push_back(
      {"M46", "arrays as they should be", "a.vtp",
       with_array("PointData", named + " NumberOfComponents=\"2\"", "1 2 3 4 5 6 7 nan"),
       Accepted{4, 2}});
  cases.push_back({"M46", "texts as they should be", "a.vtp",
                   with_array("CellData", "type=\"String\" Name=\"names\"", "65 0 0"),
                   Accepted{4, 2}});

  // In PLY an array is a property; what its lines lack the next would have to give.
  const std::string with_property =
      changed(kPly, "property double z\n", "property double z\nproperty float stiffness\n");
  cases.push_back({"M46", "a property that the vertices of PLY do not have", "a.ply", with_property,
                   Refused{":11", {"the line ends", "stiffness is expected"}}});
  cases.push_back({"M46", "words in a property of PLY", "a.ply",
                   changed(with_property, "end_header\n0 0 0\n", "end_header\n0 0 0 soft\n"),
                   Refused{":11", {"stiffness = \"soft\" is not a number"}}});
  cases.push_back({"M46", "a property of PLY without type", "a.ply",
                   changed(kPly, "property double z\n", "property double z\nproperty stiffness\n"),
                   Refused{":7", {"\"property <type> <name>\""}}});
  cases.push_back(
      {"M46", "a property of PLY of an unknown type", "a.ply",
       changed(kPly, "property double z\n", "property double z\nproperty complex stiffness\n"),
       Refused{":7", {"\"complex\" is no type"}}});
  cases.push_back(
      {"M46", "a list of PLY without the type of its length", "a.ply",
       changed(kPly, "property double z\n", "property double z\nproperty list int tags\n"),
       Refused{":7", {"\"property list <type> <type> <name>\""}}});
  const std::string binary =
      changed(kLittle, "property double z\n", "property double z\nproperty float stiffness\n");
  cases.push_back({"M46", "a property that the vertices of binary PLY do not have", "a.ply", binary,
                   Refused{at_byte(body_of(binary) + 4 * 28), {"face 0", "has 0 corners"}}});
}

}  // namespace

const std::vector<MeshCase>& mesh_cases() {
  static const Cases cases = [] {
    Cases all;
    add_files(all);
    add_stl(all);
    add_coordinates(all);
    add_indices(all);
    add_counts(all);
    add_ply_headers(all);
    add_faces(all);
    add_topology(all);
    add_text(all);
    add_vtp(all);
    add_arrays(all);
    return all;
  }();
  return cases;
}

}  // namespace palpation::catalogue
