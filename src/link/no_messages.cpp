// In place of messages.cpp where OpenIGTLink's library was not found.
#include "link/messages.h"
#include "palpation/base/error.h"

namespace palpation::link {

void require_openigtlink() {
  throw WriteError(
      "link: this palpate was built without OpenIGTLink: install libopenigtlink-dev (Debian 12 has "
      "version 1.11) and build it again; palpate export DIR --for slicer needs nothing");
}

std::string polydata_message(const std::string&, const VtpShape&, const Vec3&, Frame) {
  require_openigtlink();
  return {};
}

std::string point_message(const results::NamedMarks&, Frame) {
  require_openigtlink();
  return {};
}

std::string transform_message(const std::string&, const Eigen::Matrix3d&, const Vec3&, Frame) {
  require_openigtlink();
  return {};
}

std::string string_message(const std::string&, const std::string&) {
  require_openigtlink();
  return {};
}

std::string status_message(const std::string&, Status, const std::string&) {
  require_openigtlink();
  return {};
}

std::string capability_message(const std::string&, const std::vector<std::string>&) {
  require_openigtlink();
  return {};
}

}  // namespace palpation::link
