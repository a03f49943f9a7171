// Pictures as they come out, at places where a person knows what must be there.
#include <gtest/gtest.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>

#include <cstdio>

#include "draw/chart.h"
#include "draw/offscreen.h"
#include "draw/tissue.h"
#include "draw/tissue_view.h"
#include "io/temporary_folder.h"
#include "palpation/base/error.h"

namespace palpation::draw {
namespace {

/// A PNG file's pixels, counted as the sheet's are: from the lower left corner.
class Image {
 public:
  explicit Image(const std::string& png) {
    const TemporaryFolder folder;
    const std::string path = folder.file("picture.png", png).string();
    reader_->SetFileName(path.c_str());
    reader_->Update();
  }
  int width() const { return reader_->GetOutput()->GetDimensions()[0]; }
  int height() const { return reader_->GetOutput()->GetDimensions()[1]; }
  Colour at(int x, int y) const {
    const auto* pixel =
        static_cast<const unsigned char*>(reader_->GetOutput()->GetScalarPointer(x, y, 0));
    return {pixel[0], pixel[1], pixel[2]};
  }

 private:
  vtkNew<vtkPNGReader> reader_;
};

// One step of rounding in the driver and one in the average of four pixels.
void expect_colour(Colour drawn, Colour wanted, const char* where) {
  EXPECT_NEAR(drawn.red, wanted.red, 2) << where;
  EXPECT_NEAR(drawn.green, wanted.green, 2) << where;
  EXPECT_NEAR(drawn.blue, wanted.blue, 2) << where;
}

class Pixels : public testing::Test {
 protected:
  void SetUp() override {
    silence_graphics_libraries();
    try {
      offscreen_window(8, 8);
    } catch (const NoGraphics& error) {
      std::fprintf(stderr, "skipped: %s\n", error.what());
      GTEST_SKIP() << error.what();
    }
  }
};

TEST_F(Pixels, ShowBoxesDiscsAndLinesWhereTheyWereDrawn) {
  constexpr Colour kRed{200, 30, 20}, kBlue{10, 60, 220};
  Sheet sheet(200, 100);
  sheet.fill(Box{20.0, 10.0, 60.0, 40.0}, kRed);
  sheet.disc({140.0, 50.0}, 20.0, kBlue);
  sheet.line({20.0, 80.0}, {180.0, 80.0}, {.width_px = 6.0, .colour = kInk});
  const Image image(sheet.png());
  ASSERT_EQ(image.width(), 200);
  ASSERT_EQ(image.height(), 100);
  expect_colour(image.at(50, 30), kRed, "in the box");
  expect_colour(image.at(22, 12), kRed, "in its corner");
  expect_colour(image.at(17, 7), kWhite, "beside it");
  expect_colour(image.at(140, 66), kBlue, "in the disc");
  expect_colour(image.at(158, 68), kWhite, "in the corner of the square around it");
  expect_colour(image.at(100, 80), kInk, "on the line");
  expect_colour(image.at(100, 88), kWhite, "above it");
}

TEST_F(Pixels, ShowWhatWasDrawnLastOnTop) {
  Sheet sheet(40, 40);
  sheet.fill(Box{0.0, 0.0, 40.0, 40.0}, kInk);
  sheet.fill(Box{10.0, 10.0, 20.0, 20.0}, kAmber);
  const Image image(sheet.png());
  expect_colour(image.at(20, 20), kAmber, "the later one");
  expect_colour(image.at(5, 5), kInk, "the earlier one");
}

// A field that is x alone: its lowest colour on the left, its highest on the right, white between.
TEST_F(Pixels, ShowAFieldInTheColoursOfItsScale) {
  Outcome outcome = outcome_on_rectangle(0.02, 0.02);
  add_field(*outcome.surface, "mean", [](const Vec3& place) { return place.x(); });
  const ColourScale scale{Palette::BlueWhiteRed, 0.0, 0.02};
  const View view = view_of(outcome, std::nullopt);
  const Box map{50.0, 20.0, 200.0, 200.0};
  Sheet sheet(300, 240);
  TissueScene scene(sheet.scene(map), view, map);
  scene.paint_field(outcome, *outcome.field("mean"), scale);
  scene.finish();
  const Image image(sheet.png());
  // Where a share of the tissue's width is seen: between the margins of the view.
  const auto column = [&](double share) {
    return static_cast<int>(map.left + map.width * (20.0 * share - view.left_mm) / view.width_mm);
  };
  for (const double share : {0.1, 0.5, 0.9}) {
    // A pixel's width of the steepest part of the palette is two steps more.
    const Colour drawn = image.at(column(share), 120), wanted = scale.at(0.02 * share);
    EXPECT_NEAR(drawn.red, wanted.red, 4) << share;
    EXPECT_NEAR(drawn.green, wanted.green, 4) << share;
    EXPECT_NEAR(drawn.blue, wanted.blue, 4) << share;
  }
  expect_colour(image.at(20, 120), kWhite, "beside the map");
}

TEST_F(Pixels, ShowTouchesAboveCurvesAboveTheField) {
  Outcome outcome = outcome_on_rectangle(0.02, 0.02);
  add_field(*outcome.surface, "mean", [](const Vec3&) { return 1.0; });
  const View view = view_of(outcome, std::nullopt);
  const Box map{0.0, 0.0, 200.0, 200.0};
  Sheet sheet(200, 200);
  TissueScene scene(sheet.scene(map), view, map);
  const ColourScale scale{Palette::Viridis, 0.0, 1.0};
  scene.paint_field(outcome, *outcome.field("mean"), scale);
  scene.draw_curves(outcome, "estimate", {.width_px = 8.0, .colour = kCutPurple});
  scene.draw_touches({{.position = {0.005, 0.005, 0.0}, .set_aside = true}}, /*radius_px=*/12.0);
  scene.finish();
  const Image image(sheet.png());
  const auto pixel = [&](double x_mm, double y_mm) {
    return image.at(static_cast<int>(map.width * (x_mm - view.left_mm) / view.width_mm),
                    static_cast<int>(map.height * (y_mm - view.bottom_mm) / view.height_mm));
  };
  expect_colour(pixel(10.0, 10.0), scale.at(1.0), "inside the square: the field");
  expect_colour(pixel(10.0, 5.0), kCutPurple, "its lower side: the curve");
  expect_colour(pixel(5.0, 5.0), kAmber, "its corner: the touch");
}

TEST_F(Pixels, ShowAChartOfTheSizeAskedForAndRefuseAnEmptyOne) {
  Chart chart;
  EXPECT_THROW(picture_of(chart), InvalidInput);
  chart.x = {0.0, 1.0, 2.0};
  chart.curves = {{"flat", {1.0, 1.0, 1.0}, {}}};
  chart.width_px = 400;
  chart.height_px = 300;
  const Image image(picture_of(chart));
  EXPECT_EQ(image.width(), 400);
  EXPECT_EQ(image.height(), 300);
  // A level curve crosses the middle of the sheet: its colour is in the middle column.
  int found = 0;
  for (int y = 0; y < 300; ++y) {
    const Colour here = image.at(200, y);
    found += here.red == curve_colour(0).red && here.green == curve_colour(0).green &&
             here.blue == curve_colour(0).blue;
  }
  EXPECT_GE(found, 1);
  EXPECT_LE(found, 30);
}

}  // namespace
}  // namespace palpation::draw
