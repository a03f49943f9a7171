#include "link/in_patient.h"

#include "io/length_scale.h"

namespace palpation::link {
namespace {

constexpr std::size_t kMostWords_bytes = 60'000;

bool continues_a_character(char byte) { return (static_cast<unsigned char>(byte) & 0xc0) == 0x80; }

}  // namespace

std::string_view body_of(std::string_view message) {
  return message.substr(std::min(kHeader_bytes, message.size()));
}

Eigen::Matrix3d to_ras(Frame frame) {
  const double sign = frame == Frame::Lps ? -1.0 : 1.0;
  return Vec3(sign, sign, 1.0).asDiagonal();
}

Vec3 ras_mm(const Vec3& place_m, Frame frame) {
  const Vec3 mm =
      place_m.unaryExpr([](double value) { return from_metres(value, LengthUnit::Millimetre); });
  return to_ras(frame) * mm;
}

std::string fitting(const std::string& words) {
  if (words.size() <= kMostWords_bytes) return words;
  std::size_t end = kMostWords_bytes;
  while (end > 0 && continues_a_character(words[end])) --end;
  return words.substr(0, end) + "...";
}

std::string name_of(Status status) {
  switch (status) {
    case Status::Ok:
      return "OK";
    case Status::UnknownError:
      return "UnknownError";
    case Status::NotFound:
      return "NotFound";
    case Status::Busy:
      return "Busy";
    case Status::ShutDown:
      return "ShutDown";
  }
  return "UnknownError";
}

}  // namespace palpation::link
