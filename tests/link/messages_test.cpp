// What is packed, unpacked by OpenIGTLink's own library, as 3D Slicer does; tests/tool/igtl.py
// reads it by the protocol alone.
#include "link/messages.h"

#include <gtest/gtest.h>
#include <igtlPointMessage.h>
#include <igtlPolyDataMessage.h>
#include <igtlStringMessage.h>
#include <igtlTransformMessage.h>

#include <Eigen/Geometry>
#include <cstring>

namespace palpation::link {
namespace {

/// With its CRC checked.
template <typename Message>
typename Message::Pointer unpacked(const std::string& bytes) {
  const igtl::MessageHeader::Pointer header = igtl::MessageHeader::New();
  header->InitPack();
  std::memcpy(header->GetPackPointer(), bytes.data(), kHeader_bytes);
  header->Unpack();
  typename Message::Pointer message = Message::New();
  message->SetMessageHeader(header);
  message->AllocatePack();
  EXPECT_EQ(message->GetPackBodySize(), static_cast<int>(body_of(bytes).size()));
  std::memcpy(message->GetPackBodyPointer(), body_of(bytes).data(), body_of(bytes).size());
  EXPECT_NE(message->Unpack(1) & igtl::MessageHeader::UNPACK_BODY, 0);
  return message;
}

Vec3 place_in(igtl::PolyDataMessage& message, unsigned point) {
  float x = 0, y = 0, z = 0;
  message.GetPoints()->GetPoint(point, x, y, z);
  return {x, y, z};
}

VtpShape triangle() {
  VtpShape model;
  model.points = {Vec3(0.001, 0, 0), Vec3(0, 0.002, 0), Vec3(0, 0, 0.003)};
  model.triangles = {{0, 1, 2}};
  model.point_fields = {{"mean", {1, 2, 3}}, {"stddev", {4, 5, 6}}};
  return model;
}

TEST(Messages, AModelHasItsPlacesInMillimetresAndItsFields) {
  const auto message =
      unpacked<igtl::PolyDataMessage>(polydata_message("tissue", triangle(), {}, Frame::Ras));
  EXPECT_STREQ(message->GetDeviceName(), "tissue");
  EXPECT_EQ(place_in(*message, 2), Vec3(0, 0, 3));
  igtlUint32 corners[3];
  message->GetPolygons()->GetCell(0, corners);
  EXPECT_EQ(corners[2], 2u);
  ASSERT_EQ(message->GetNumberOfAttributes(), 2);
  float values[3];
  message->GetAttribute(1)->GetData(values);
  EXPECT_EQ(values[2], 6.0f);
}

TEST(Messages, OfLpsXAndYChangeTheirSignsAndHandsStayHands) {
  const auto model =
      unpacked<igtl::PolyDataMessage>(polydata_message("tissue", triangle(), {}, Frame::Lps));
  EXPECT_EQ(place_in(*model, 0), Vec3(-1, 0, 0));
  EXPECT_EQ(place_in(*model, 1), Vec3(0, -2, 0));
  const Eigen::Matrix3d down = Eigen::AngleAxisd(M_PI, Vec3::UnitX()).toRotationMatrix();
  const auto probe = unpacked<igtl::TransformMessage>(
      transform_message("probe", down, Vec3(0.001, 0.002, 0.003), Frame::Lps));
  igtl::Matrix4x4 matrix;
  probe->GetMatrix(matrix);
  Eigen::Matrix3d rotation;
  for (int i = 0; i < 9; ++i) rotation(i / 3, i % 3) = matrix[i / 3][i % 3];
  EXPECT_NEAR(rotation.determinant(), 1.0, 1e-6);  // of float32
  EXPECT_EQ(Vec3(matrix[0][3], matrix[1][3], matrix[2][3]), Vec3(-1, -2, 3));
}

TEST(Messages, WhatIsToldOfLinesIsToldOfTheirPoints) {
  VtpShape model;
  model.points = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(2, 0, 0), Vec3(3, 0, 0)};
  model.lines = {{0, 1, 0}, {2, 3, 2}};
  model.cell_fields = {{"part", {7, 8}}};
  const auto message =
      unpacked<igtl::PolyDataMessage>(polydata_message("outline", model, {}, Frame::Ras));
  ASSERT_EQ(message->GetLines()->GetNumberOfCells(), 2u);
  ASSERT_EQ(message->GetNumberOfAttributes(), 1);
  ASSERT_EQ(message->GetAttribute(0)->GetSize(), 4u);
  float values[4];
  message->GetAttribute(0)->GetData(values);
  EXPECT_EQ(values[1], 7.0f);
  EXPECT_EQ(values[2], 8.0f);
}

TEST(Messages, OfNothingThereIsAPointToHoldOnTo) {
  const auto message = unpacked<igtl::PolyDataMessage>(
      polydata_message("outline", {}, Vec3(0.005, 0, 0), Frame::Lps));
  ASSERT_EQ(message->GetPoints()->GetNumberOfPoints(), 1);
  EXPECT_EQ(place_in(*message, 0), Vec3(-5, 0, 0));
  const auto points = unpacked<igtl::PointMessage>(point_message({"missed", {}, {}}, Frame::Ras));
  EXPECT_EQ(points->GetNumberOfPointElement(), 0);
}

TEST(Messages, WordsThatDoNotFitAreCutBetweenTwoCharacters) {
  std::string words = "x";
  for (int i = 0; i < 40'000; ++i) words += "\u00b2";
  const auto message = unpacked<igtl::StringMessage>(string_message("conclusion", words));
  const std::string text = message->GetString();
  EXPECT_EQ(text.size(), 59'999u + 3u);
  EXPECT_TRUE(text.ends_with("\u00b2..."));
  EXPECT_EQ(message->GetEncoding(), 106);
}

TEST(Messages, TheTimeAloneIsNoChangeOfTheBody) {
  const std::string first = string_message("conclusion", "one tumour");
  const std::string second = string_message("conclusion", "one tumour");
  EXPECT_EQ(body_of(first), body_of(second));
  EXPECT_NE(body_of(first), body_of(string_message("conclusion", "no tumour")));
}

}  // namespace
}  // namespace palpation::link
