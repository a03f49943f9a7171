#include "link/messages.h"

#include <igtlCapabilityMessage.h>
#include <igtlPointMessage.h>
#include <igtlPolyDataMessage.h>
#include <igtlStatusMessage.h>
#include <igtlStringMessage.h>
#include <igtlTransformMessage.h>
#include <igtl_util.h>

#include <cmath>
#include <list>

#include "link/in_patient.h"
#include "palpation/base/error.h"

namespace palpation::link {
namespace {

constexpr std::uint16_t kUtf8 = 106;  // IANA's number of the character set
constexpr float kPointDiameter_mm = 2.0f;

std::string packed(igtl::MessageBase& message) {
  const igtl::TimeStamp::Pointer now = igtl::TimeStamp::New();
  now->GetTime();
  igtl::TimeStamp::Pointer stamp = now;
  message.SetTimeStamp(stamp);
  message.Pack();
  return {static_cast<const char*>(message.GetPackPointer()),
          static_cast<std::size_t>(message.GetPackSize())};
}

void add_points(igtl::PolyDataMessage& message, const VtpShape& model, Frame frame) {
  const igtl::PolyDataPointArray::Pointer points = igtl::PolyDataPointArray::New();
  points->SetNumberOfPoints(static_cast<int>(model.points.size()));
  for (std::size_t i = 0; i < model.points.size(); ++i) {
    const Eigen::Vector3f p = ras_mm(model.points[i], frame).cast<float>();
    points->SetPoint(static_cast<unsigned>(i), p.x(), p.y(), p.z());
  }
  message.SetPoints(points);
}

template <typename Cells>
igtl::PolyDataCellArray::Pointer cells_of(const Cells& cells) {
  igtl::PolyDataCellArray::Pointer array = igtl::PolyDataCellArray::New();
  for (const auto& cell : cells) array->AddCell(std::list<igtlUint32>(cell.begin(), cell.end()));
  return array;
}

void add_field(igtl::PolyDataMessage& message, const std::string& name,
               const std::vector<double>& values) {
  std::vector<igtlFloat32> floats(values.begin(), values.end());
  const igtl::PolyDataAttribute::Pointer field = igtl::PolyDataAttribute::New();
  field->SetType(igtl::PolyDataAttribute::POINT_SCALAR);
  field->SetName(name.c_str());
  field->SetSize(static_cast<igtlUint32>(floats.size()));
  field->SetData(floats.data());
  message.AddAttribute(field);
}

/// What is told of lines, told of their points: the library (1.11) gives a scalar of cells nine
/// components and reads as many.
void add_fields_of_lines(igtl::PolyDataMessage& message, const VtpShape& model) {
  for (const auto& [name, values] : model.cell_fields) {
    std::vector<double> of_points(model.points.size(), 0.0);
    for (std::size_t line = 0; line < model.lines.size(); ++line)
      for (const int point : model.lines[line])
        of_points[static_cast<std::size_t>(point)] = values[line];
    add_field(message, name, of_points);
  }
}

igtlUint8 byte_of(double share) { return static_cast<igtlUint8>(std::lround(255.0 * share)); }

/// A list without points would have no body, and libraries, 3D Slicer's too, take what has none for
/// not received: what was shown would stay. So it has one byte, which is the body of no point, and
/// of which all of them make an empty list.
std::string list_without_points(std::string message) {
  std::string sums;  // of the header: how large the body is, and its CRC
  unsigned char body = 0;
  for (const igtl_uint64 number : {igtl_uint64{1}, crc64(&body, 1, 0)})
    for (int shift = 56; shift >= 0; shift -= 8) sums += static_cast<char>(number >> shift & 0xff);
  message.replace(kHeader_bytes - sums.size(), std::string::npos, sums);
  return message + static_cast<char>(body);
}

}  // namespace

void require_openigtlink() {}

std::string polydata_message(const std::string& device, const VtpShape& model, const Vec3& anchor,
                             Frame frame) {
  const igtl::PolyDataMessage::Pointer message = igtl::PolyDataMessage::New();
  message->SetDeviceName(device.c_str());
  if (model.points.empty()) {
    VtpShape nothing;
    nothing.points.push_back(anchor);
    add_points(*message, nothing, frame);
    return packed(*message);
  }
  add_points(*message, model, frame);
  if (!model.lines.empty()) message->SetLines(cells_of(model.lines));
  if (!model.triangles.empty()) message->SetPolygons(cells_of(model.triangles));
  for (const auto& [name, values] : model.point_fields) add_field(*message, name, values);
  if (model.triangles.empty()) add_fields_of_lines(*message, model);
  return packed(*message);
}

std::string point_message(const results::NamedMarks& list, Frame frame) {
  const igtl::PointMessage::Pointer message = igtl::PointMessage::New();
  message->SetDeviceName(list.name.c_str());
  for (const results::Mark& mark : list.marks) {
    igtl::PointElement::Pointer point = igtl::PointElement::New();
    point->SetName(mark.label.c_str());
    point->SetGroupName(list.name.c_str());
    point->SetRGBA(byte_of(list.colour[0]), byte_of(list.colour[1]), byte_of(list.colour[2]), 255);
    const Eigen::Vector3f p = ras_mm(mark.place, frame).cast<float>();
    point->SetPosition(p.x(), p.y(), p.z());
    point->SetRadius(kPointDiameter_mm);
    message->AddPointElement(point);
  }
  return list.marks.empty() ? list_without_points(packed(*message)) : packed(*message);
}

std::string transform_message(const std::string& device, const Eigen::Matrix3d& rotation,
                              const Vec3& place, Frame frame) {
  const igtl::TransformMessage::Pointer message = igtl::TransformMessage::New();
  message->SetDeviceName(device.c_str());
  const Eigen::Matrix3d turned = to_ras(frame) * rotation;
  const Vec3 at = ras_mm(place, frame);
  igtl::Matrix4x4 matrix = {};
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column)
      matrix[row][column] = static_cast<float>(turned(row, column));
    matrix[row][3] = static_cast<float>(at[row]);
  }
  matrix[3][3] = 1.0f;
  message->SetMatrix(matrix);
  return packed(*message);
}

std::string string_message(const std::string& device, const std::string& words) {
  const igtl::StringMessage::Pointer message = igtl::StringMessage::New();
  message->SetDeviceName(device.c_str());
  std::string text = fitting(words);
  message->SetEncoding(kUtf8);
  message->SetString(text);
  return packed(*message);
}

std::string status_message(const std::string& device, Status status, const std::string& words) {
  const igtl::StatusMessage::Pointer message = igtl::StatusMessage::New();
  message->SetDeviceName(device.c_str());
  message->SetCode(static_cast<int>(status));
  message->SetSubCode(0);
  message->SetErrorName(name_of(status).c_str());
  message->SetStatusString(fitting(words).c_str());
  return packed(*message);
}

std::string capability_message(const std::string& device, const std::vector<std::string>& kinds) {
  const igtl::CapabilityMessage::Pointer message = igtl::CapabilityMessage::New();
  message->SetDeviceName(device.c_str());
  message->SetTypes(kinds);
  return packed(*message);
}

}  // namespace palpation::link
