// Numbers beside dots: legible, and of their own dot.
#include "draw/stop_numbers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace palpation::draw {
namespace {

constexpr double kRadius_px = 5.0;
const Box kMap{100.0, 50.0, 300.0, 600.0};

bool overlap(const Box& a, const Box& b) {
  constexpr double kTouching_px = 1e-9;
  return std::min(a.right(), b.right()) - std::max(a.left, b.left) > kTouching_px &&
         std::min(a.top(), b.top()) - std::max(a.bottom, b.bottom) > kTouching_px;
}

bool hides(const Box& box, const Pixel& dot) {
  const Pixel nearest(std::clamp(dot.x(), box.left, box.right()),
                      std::clamp(dot.y(), box.bottom, box.top()));
  return (nearest - dot).norm() < kRadius_px;
}

std::vector<Box> beside(const std::vector<Pixel>& dots, const std::vector<Pixel>& others = {}) {
  return boxes_beside(dots, std::vector<Pixel>(dots.size(), Pixel(18.0, 16.0)), others, kRadius_px,
                      kMap);
}

TEST(StopNumbers, StandToTheRightWhereThereIsRoom) {
  const Box box = beside({kMap.centre()}).front();
  EXPECT_GT(box.left, kMap.centre().x() + kRadius_px);
  EXPECT_DOUBLE_EQ(box.centre().y(), kMap.centre().y());
}

TEST(StopNumbers, GiveWayToOtherTouches) {
  const Pixel other = kMap.centre() + Pixel(14.0, 0.0);
  const Box box = beside({kMap.centre()}, {other}).front();
  EXPECT_FALSE(hides(box, other));
  EXPECT_LT(box.right(), kMap.centre().x());
}

TEST(StopNumbers, StayInTheMapAtItsCorners) {
  for (const double x : {kMap.left, kMap.right()})
    for (const double y : {kMap.bottom, kMap.top()}) {
      const Box box = beside({Pixel(x, y)}).front();
      EXPECT_GE(box.left, kMap.left);
      EXPECT_LE(box.right(), kMap.right());
      EXPECT_GE(box.bottom, kMap.bottom);
      EXPECT_LE(box.top(), kMap.top());
      EXPECT_FALSE(hides(box, Pixel(x, y)));
    }
}

TEST(StopNumbers, HideNoDotAndNoNumberOfATourAlongABoundary) {
  std::vector<Pixel> dots;
  for (int i = 0; i < 10; ++i)
    dots.push_back(kMap.centre() + 60.0 * Pixel(std::cos(0.628 * i), std::sin(0.628 * i)));
  const std::vector<Box> boxes = beside(dots);
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    for (const Pixel& dot : dots) EXPECT_FALSE(hides(boxes[i], dot)) << i;
    for (std::size_t j = 0; j < i; ++j) EXPECT_FALSE(overlap(boxes[i], boxes[j])) << i << " " << j;
  }
}

TEST(StopNumbers, KeepToTheirDotsWhereThereIsNoRoomAtAll) {
  const std::vector<Pixel> dots(12, kMap.centre());
  for (const Box& box : beside(dots)) EXPECT_LT((box.centre() - kMap.centre()).norm(), 25.0);
}

}  // namespace
}  // namespace palpation::draw
