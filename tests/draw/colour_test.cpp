#include "draw/colour.h"

#include <gtest/gtest.h>
#include <vtkLookupTable.h>

#include <cmath>
#include <set>
#include <tuple>

namespace palpation::draw {
namespace {

std::tuple<int, int, int> rgb(Colour colour) { return {colour.red, colour.green, colour.blue}; }

/// Relative luminance (ITU-R BT.709) of a colour whose channels are taken for linear: monotone is
/// what matters here.
double luminance(Colour colour) {
  return 0.2126 * colour.red + 0.7152 * colour.green + 0.0722 * colour.blue;
}

TEST(Mix, GoesEvenlyFromOneColourToTheOther) {
  const Colour black{0, 0, 0}, orange{200, 100, 0};
  EXPECT_EQ(rgb(mix(black, orange, 0.0)), rgb(black));
  EXPECT_EQ(rgb(mix(black, orange, 0.5)), std::tuple(100, 50, 0));
  EXPECT_EQ(rgb(mix(orange, black, 0.25)), std::tuple(150, 75, 0));
  EXPECT_EQ(rgb(mix(black, orange, 1.0)), rgb(orange));
}

TEST(ColourScale, IsWhiteInTheMiddleOfADivergingPalette) {
  const ColourScale scale{Palette::BlueWhiteRed, 7.0, 9.0};
  EXPECT_EQ(rgb(scale.at(8.0)), std::tuple(252, 252, 252));
  EXPECT_GT(scale.at(7.2).blue, scale.at(7.2).red);
  EXPECT_GT(scale.at(8.8).red, scale.at(8.8).blue);
}

TEST(ColourScale, KeepsItsEndsBeyondThem) {
  const ColourScale scale{Palette::Viridis, 0.0, 1.0};
  EXPECT_EQ(rgb(scale.at(-3.0)), rgb(scale.at(0.0)));
  EXPECT_EQ(rgb(scale.at(40.0)), rgb(scale.at(1.0)));
  EXPECT_EQ(rgb(scale.at(0.0)), std::tuple(68, 1, 84));
  EXPECT_EQ(rgb(scale.at(1.0)), std::tuple(253, 231, 37));
}

TEST(ColourScale, HasAGreyForNoNumber) {
  EXPECT_EQ(rgb(ColourScale{}.at(std::nan(""))), std::tuple(225, 225, 225));
}

TEST(ColourScale, GrowsLighterAlongViridisAndDarkerAlongWhitePurple) {
  const ColourScale viridis{Palette::Viridis, 0.0, 100.0}, purple{Palette::WhitePurple, 0.0, 100.0};
  for (int value = 1; value <= 100; ++value) {
    EXPECT_GT(luminance(viridis.at(value)), luminance(viridis.at(value - 1))) << value;
    EXPECT_LT(luminance(purple.at(value)), luminance(purple.at(value - 1))) << value;
  }
}

// The table has 512 steps, none of which changes a channel by more than two.
TEST(ColourScale, GivesTheSameColoursAsATable) {
  for (const Palette palette : {Palette::BlueWhiteRed, Palette::Viridis, Palette::WhitePurple}) {
    const ColourScale scale{palette, -2.0, 6.0};
    const vtkSmartPointer<vtkLookupTable> table = scale.table();
    for (double value = -2.0; value <= 6.0; value += 0.125) {
      double channels[3];
      table->GetColor(value, channels);
      const Colour direct = scale.at(value);
      EXPECT_NEAR(255.0 * channels[0], direct.red, 2.0);
      EXPECT_NEAR(255.0 * channels[1], direct.green, 2.0);
      EXPECT_NEAR(255.0 * channels[2], direct.blue, 2.0);
    }
  }
}

TEST(CurveColour, HasEightThatDifferAndBeginsAgain) {
  std::set<std::tuple<int, int, int>> seen;
  for (std::size_t curve = 0; curve < 8; ++curve) seen.insert(rgb(curve_colour(curve)));
  EXPECT_EQ(seen.size(), 8u);
  EXPECT_EQ(rgb(curve_colour(8)), rgb(curve_colour(0)));
}

}  // namespace
}  // namespace palpation::draw
