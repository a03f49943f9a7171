#include "draw/layout.h"

#include <gtest/gtest.h>

#include <cmath>

#include "draw/tissue.h"

namespace palpation::draw {
namespace {

Layout layout_on(double width_m, double height_m) {
  const Outcome outcome = outcome_on_rectangle(width_m, height_m);
  const View view = view_of(outcome, std::nullopt);
  return layout_of(outcome, view, view);
}

bool overlap(const Box& a, const Box& b) {
  return a.left < b.right() && b.left < a.right() && a.bottom < b.top() && b.bottom < a.top();
}

void expect_in_order(const Layout& layout) {
  for (std::size_t i = 0; i < 3; ++i) {
    const Box& map = layout.maps[i];
    EXPECT_GE(map.left, 0.0);
    EXPECT_GE(map.bottom, kCaption_px);
    EXPECT_LE(map.right() + kRightOfMap_px, layout.width_px);
    EXPECT_LE(map.top(), layout.height_px);
    EXPECT_EQ(map.width, layout.maps[0].width);
    EXPECT_EQ(map.height, layout.maps[0].height);
    for (std::size_t j = 0; j < i; ++j) EXPECT_FALSE(overlap(map, layout.maps[j])) << i << j;
  }
}

TEST(Layout, PutsThreeEqualMapsSideBySide) {
  for (const double width_m : {0.01, 0.025, 0.05, 0.09}) {
    const Layout layout = layout_on(width_m, 0.05);
    expect_in_order(layout);
    EXPECT_EQ(layout.width_px, 1800);
    EXPECT_EQ(layout.maps[0].bottom, layout.maps[2].bottom);
    EXPECT_LT(layout.maps[0].right(), layout.maps[1].left);
    EXPECT_LT(layout.maps[1].right(), layout.maps[2].left);
  }
}

TEST(Layout, PutsMapsOfWideTissueOneAboveTheOther) {
  const Layout layout = layout_on(0.10, 0.05);
  expect_in_order(layout);
  EXPECT_EQ(layout.width_px, 1300);
  EXPECT_EQ(layout.maps[0].left, layout.maps[2].left);
  EXPECT_GT(layout.maps[0].bottom, layout.maps[1].top());
  EXPECT_GT(layout.maps[1].bottom, layout.maps[2].top());
}

// Both sides are whole pixels, so the height is at most one off.
TEST(Layout, KeepsTheShapeOfTheTissue) {
  const Outcome outcome = outcome_on_rectangle(0.025, 0.05);
  const View view = view_of(outcome, std::nullopt);
  const Box map = layout_of(outcome, view, view).maps[0];
  EXPECT_NEAR(map.height, map.width * view.height_mm / view.width_mm, 1.0);
}

TEST(Legend, NamesOnlyWhatOccurs) {
  Outcome outcome = outcome_on_rectangle(0.025, 0.05);
  const auto words = [&] {
    std::vector<std::string> all;
    for (const auto& row : legend_rows(outcome, 1e6)) {
      for (const LegendEntry& entry : row) all.push_back(entry.words);
    }
    return all;
  };
  EXPECT_EQ(words(), std::vector<std::string>{"estimated boundary"});
  outcome.touches.push_back({.initial = true});
  EXPECT_EQ(words(), (std::vector<std::string>{"estimated boundary", "initial samples"}));
  outcome.curves.clear();
  outcome.touches[0].set_aside = true;
  EXPECT_EQ(words(), std::vector<std::string>{"set aside"});
}

TEST(Legend, BreaksIntoAsManyRowsAsTheWidthNeeds) {
  Outcome outcome = outcome_on_rectangle(0.025, 0.05);
  outcome.touches = {{.initial = true}, {}, {.on_the_way = true}, {.set_aside = true}};
  EXPECT_EQ(legend_rows(outcome, 1e6).size(), 1u);
  EXPECT_EQ(legend_rows(outcome, 1.0).size(), 5u);  // at least one in each
  const std::size_t rows = legend_rows(outcome, 500.0).size();
  EXPECT_GT(rows, 1u);
  EXPECT_LT(rows, 5u);
}

TEST(Legend, TakesItsRowsFromTheMaps) {
  Outcome outcome = outcome_on_rectangle(0.10, 0.05);
  const View view = view_of(outcome, std::nullopt);
  const Layout plain = layout_of(outcome, view, view);
  outcome.touches = {{.initial = true}, {}, {.on_the_way = true}, {.set_aside = true}};
  outcome.curves.push_back({"truth", outcome.curves[0].points});
  outcome.summary.truth_line = std::string(100, 'x');
  const Layout full = layout_of(outcome, view, view);
  ASSERT_GT(full.legend.size(), plain.legend.size());
  EXPECT_EQ(full.maps[2].bottom - plain.maps[2].bottom,
            kLegendRow_px * static_cast<double>(full.legend.size() - plain.legend.size()));
}

}  // namespace
}  // namespace palpation::draw
