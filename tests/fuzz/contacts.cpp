// Contacts and clouds of points (CSV, XYZ, PLY), up to the surface through them.
#include "palpation/io/contacts.h"

#include "fuzz/target.h"
#include "palpation/base/error.h"
#include "palpation/geometry/reconstruct.h"

namespace palpation::fuzz {
namespace {

constexpr Eigen::Index kFew = 200;

void check_promises(const ContactsFile& file) {
  expect(file.points.rows() > 0, "a file that was read has contacts");
  expect(file.points.allFinite(), "contacts are finite");
  expect(file.places.size() == static_cast<std::size_t>(file.points.rows()),
         "each contact has its line");
  expect(file.outward.rows() == 0 || file.outward.rows() == file.points.rows(),
         "all contacts have a direction, or none");
  for (const auto& outward : file.outward.rowwise())
    expect(std::abs(outward.norm() - 1.0) < 1e-9, "a direction is a unit vector");
}

void join(const ContactsFile& file, Triangulation by) {
  const Points outward =
      file.outward.rows() > 0
          ? file.outward
          : Points(Vec3(0.0, 0.0, 1.0).transpose().replicate(file.points.rows(), 1));
  const Reconstruction rough = reconstruct(file.points, outward, {.by = by});
  expect(Surface(rough.mesh).area() > 0.0, "a surface has an area");
}

}  // namespace
}  // namespace palpation::fuzz

int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace palpation;
  const fuzz::MemoryFile file(bytes, size);
  for (const std::optional<LengthUnit> unit :
       {std::optional<LengthUnit>(), std::optional(LengthUnit::Millimetre)}) {
    try {
      const ContactsFile read = read_contacts(file.path(), {.unit = unit});
      fuzz::check_promises(read);
      if (read.points.rows() > fuzz::kFew) continue;
      for (const Triangulation by : {Triangulation::Projection, Triangulation::AdvancingFront}) {
        try {
          fuzz::join(read, by);
        } catch (const Error&) {
        }
      }
    } catch (const Error&) {
    }
  }
  return 0;
}
