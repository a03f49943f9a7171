/// What goes over the wire: OpenIGTLink's messages, packed by its library.
///
/// Bytes are a header of 58 bytes (version 1) and a body, as the protocol has them. Places come in
/// metres in the scene's frame and leave as millimetres in RAS, which OpenIGTLink asks for: of LPS
/// x and y change their signs. A name of a device has 20 bytes at most.
#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

#include "io/vtp_shape.h"
#include "results/shown.h"

namespace palpation::link {

inline constexpr std::size_t kHeader_bytes = 58;

/// What follows the header: equal where nothing changed but the time.
std::string_view body_of(std::string_view message);

/// Codes of STATUS, of the protocol's list.
enum class Status { Ok = 1, UnknownError = 2, NotFound = 4, Busy = 6, ShutDown = 19 };

/// Where this program was built without the library: throws WriteError that says so and what to
/// install.
void require_openigtlink();

/// POLYDATA: triangles and lines with one scalar of the points for each field, those of lines
/// among them; texts and dots are left out. Of a model without points the message has one point,
/// `anchor`, and nothing to draw, which takes away what was shown: readers of messages without
/// points are known to stumble.
std::string polydata_message(const std::string& device, const VtpShape& model, const Vec3& anchor,
                             Frame frame);

/// POINT: a list of places, each with its label and colour, 2 mm wide. May be empty.
std::string point_message(const results::NamedMarks& list, Frame frame);

/// TRANSFORM: from the probe (its z axis into the tissue) to RAS.
std::string transform_message(const std::string& device, const Eigen::Matrix3d& rotation,
                              const Vec3& place, Frame frame);

/// STRING, in UTF-8; what is longer than a message may be is cut off, and "..." says so.
std::string string_message(const std::string& device, const std::string& words);

std::string status_message(const std::string& device, Status status, const std::string& words);

/// CAPABILITY: the kinds of messages that are sent.
std::string capability_message(const std::string& device, const std::vector<std::string>& kinds);

}  // namespace palpation::link
