// fuzz_seeds FOLDER: what the searches start from, one folder for each target: the catalogues'
// files and some sound ones.
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

#include "io/measurement_catalogue.h"
#include "io/mesh_catalogue.h"
#include "io/mesh_seeds.h"
#include "palpation/base/random.h"
#include "tool/scene_catalogue.h"

namespace {

namespace fs = std::filesystem;
using namespace palpation;

/// Larger files slow the search down and show it nothing new.
constexpr std::size_t kLargest = 20'000;

class Folder {
 public:
  explicit Folder(fs::path root) : root_(std::move(root)) {}

  void add(const std::string& target, const std::string& bytes) {
    if (bytes.size() > kLargest) return;
    fs::create_directories(root_ / target);
    std::ofstream(root_ / target / std::to_string(count_++), std::ios::binary) << bytes;
  }

 private:
  fs::path root_;
  int count_ = 0;
};

void add_mesh(Folder& folder, const std::string& file, const std::string& bytes) {
  const std::string extension = fs::path(file).extension().string();
  for (const std::string format : {"obj", "off", "stl", "ply", "vtp"}) {
    if (extension == "." + format) folder.add(format, bytes);
  }
}

constexpr const char* kOutlines[] = {
    "POLYGON EMPTY",
    "POLYGON ((0 0, 3 0, 3 3, 0 3, 0 0))",
    "POLYGON ((0 0, 2 2, 2 0, 0 2, 0 0))",
    "POLYGON ((0 0, 4 0, 4 4, 0 4, 0 0), (1 1, 3 1, 3 3, 1 3, 1 1))",
    "POLYGON ((0 0, 4 0, 4 4, 2 4, 3 2, 1 2, 2 4, 0 4, 0 0))",
    "MULTIPOLYGON (((0 0, 3 0, 3 3, 0 0)), ((1e-3 2, 5.5 2, 5 6, 1e-3 2)))",
    "MULTIPOLYGON (((0 0, 3 0, 3 3, 0 3, 0 0), (0 0, 1 2, 2 1, 0 0)), ((5 5, 6 5, 6 6, 5 6, 5 5)))",
};

constexpr const char* kBoundary =
    "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
    "header_type=\"UInt64\"><PolyData>"
    "<Piece NumberOfPoints=\"4\" NumberOfVerts=\"0\" NumberOfLines=\"2\" NumberOfStrips=\"0\" "
    "NumberOfPolys=\"0\">"
    "<CellData><DataArray type=\"String\" Name=\"kind_name\" NumberOfTuples=\"2\" "
    "format=\"ascii\">101 115 116 105 109 97 116 101 0 "
    "98 97 110 100 0</DataArray></CellData>"
    "<Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">0.001 0.001 0 "
    "0.02 0.001 0 0.02 0.02 0 0.001 0.02 0"
    "</DataArray></Points>"
    "<Lines><DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">0 1 2 3 0 0 1 2 "
    "0</DataArray>"
    "<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">5 "
    "9</DataArray></Lines></Piece></PolyData></VTKFile>";

/// A bent sheet of 5 x 5 contacts, 4 mm apart: a line each, with `before` and `behind` its three
/// numbers.
std::string contacts(const std::string& header, const std::string& separator,
                     const std::string& before, const std::string& behind) {
  std::string text = header;
  for (int x = -8; x <= 8; x += 4) {
    for (int y = -8; y <= 8; y += 4) {
      text += before;
      text += std::to_string(x) + separator + std::to_string(y) + separator +
              std::to_string(x * x / 16) + behind;
      text += '\n';
    }
  }
  return text;
}

void add_contacts(Folder& folder) {
  folder.add("contacts", contacts("x_mm,y_mm,z_mm\n", ",", "", ""));
  folder.add("contacts", contacts("probe,contact_x_mm,contact_y_mm,contact_z_mm,normal_x,normal_y,"
                                  "normal_z,kind\n",
                                  ",", "1,", ",0,0.5,2,stop"));
  folder.add("contacts", contacts("x_mm,y_mm,z_mm,fx_n,fy_n,fz_n\n", ",", "", ",0.1,nan,1"));
  folder.add("contacts", contacts("# a cloud\n", " ", "", ""));
  folder.add("contacts", contacts("", "\t", "", " 0 0 1"));
  folder.add("contacts", contacts("ply\nformat ascii 1.0\nelement vertex 25\nproperty float x\n"
                                  "property float y\nproperty float z\nend_header\n",
                                  " ", "", ""));
}

/// A header of OpenIGTLink (version, type, device, time, size of the body, CRC) and a body.
std::string message(int version, const std::string& type, const std::string& device, int body) {
  std::string bytes(58, '\0');
  bytes[1] = static_cast<char>(version);
  bytes.replace(2, type.size(), type);
  bytes.replace(14, device.size(), device);
  bytes[49] = static_cast<char>(body);
  return bytes + std::string(static_cast<std::size_t>(body), 'b');
}

void add_messages(Folder& folder) {
  folder.add("incoming", message(1, "GET_STATUS", "", 0));
  folder.add("incoming",
             message(2, "GET_POLYDATA", "outline", 12) + message(3, "STT_TDATA", "", 0));
  folder.add("incoming",
             message(1, "TRANSFORM", "probe", 48) + message(1, "GET_CAPABIL", "", 0) +
                 "GET / HTTP/1.1\r\nHost: nobody, and much more than fifty-eight bytes");
}

std::string random_bytes(Random& random, int size) {
  std::string bytes;
  for (int i = 0; i < size; ++i) bytes += static_cast<char>(random.below(256));
  return bytes;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: %s FOLDER\n", argv[0]);
    return 2;
  }
  Folder folder(argv[1]);
  for (const catalogue::MeshCase& one : catalogue::mesh_cases())
    add_mesh(folder, one.file, one.bytes);
  for (const catalogue::MeshSeed& seed : catalogue::mesh_seeds())
    add_mesh(folder, seed.file, seed.bytes);
  for (const catalogue::SceneCase& one : catalogue::scene_cases()) folder.add("scene", one.text);
  for (const catalogue::MeasurementCase& one : catalogue::measurement_cases()) {
    folder.add("measurements", one.text);
    folder.add("recording", one.text);
  }
  for (const char* outline : kOutlines) folder.add("wkt", outline);
  folder.add("boundary", kBoundary);
  add_contacts(folder);
  add_messages(folder);
  Random random(1);
  for (int size : {30, 100, 300}) {
    folder.add("rings", random_bytes(random, size));
    folder.add("field", random_bytes(random, size));
  }
  return 0;
}
