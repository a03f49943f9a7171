#include "draw/colour.h"

#include <vtkLookupTable.h>

#include <algorithm>
#include <cmath>
#include <span>

namespace palpation::draw {
namespace {

// Moreland's cool-warm ends with a true white between them, so that "at the level" reads as no
// colour at all.
constexpr Colour kBlueWhiteRed[] = {{33, 61, 138},   {67, 112, 190},  {132, 170, 219},
                                    {200, 217, 238}, {252, 252, 252}, {246, 207, 190},
                                    {228, 146, 122}, {197, 76, 68},   {138, 19, 41}};
constexpr Colour kViridis[] = {{68, 1, 84},    {71, 45, 123},  {59, 82, 139},
                               {44, 114, 142}, {33, 145, 140}, {40, 174, 128},
                               {94, 201, 98},  {173, 220, 48}, {253, 231, 37}};
constexpr Colour kWhitePurple[] = {{252, 251, 253}, {239, 237, 245}, {218, 218, 235},
                                   {188, 189, 220}, {158, 154, 200}, {128, 125, 186},
                                   {106, 81, 163},  {84, 39, 143},   {63, 0, 125}};
constexpr Colour kCurves[] = {{0, 114, 178}, {213, 94, 0},   {0, 148, 108}, {160, 84, 150},
                              {90, 90, 90},  {86, 180, 233}, {196, 150, 0}, {140, 60, 40}};
constexpr Colour kNoValue{225, 225, 225};
constexpr int kTableSize = 512;

std::span<const Colour> colours_of(Palette palette) {
  switch (palette) {
    case Palette::BlueWhiteRed:
      return kBlueWhiteRed;
    case Palette::WhitePurple:
      return kWhitePurple;
    case Palette::Viridis:
      break;
  }
  return kViridis;
}

Colour palette_at(Palette palette, double share) {
  const std::span<const Colour> colours = colours_of(palette);
  const double place = std::clamp(share, 0.0, 1.0) * static_cast<double>(colours.size() - 1);
  const auto left = std::min(static_cast<std::size_t>(place), colours.size() - 2);
  return mix(colours[left], colours[left + 1], place - static_cast<double>(left));
}

unsigned char mix_channel(unsigned char a, unsigned char b, double share) {
  return static_cast<unsigned char>(std::lround(a + (b - a) * share));
}

}  // namespace

Colour mix(Colour a, Colour b, double share) {
  return {mix_channel(a.red, b.red, share), mix_channel(a.green, b.green, share),
          mix_channel(a.blue, b.blue, share), mix_channel(a.alpha, b.alpha, share)};
}

Colour curve_colour(std::size_t index) { return kCurves[index % std::size(kCurves)]; }

Colour ColourScale::at(double value) const {
  if (!std::isfinite(value)) return kNoValue;
  return palette_at(palette, (value - lowest) / (highest - lowest));
}

vtkSmartPointer<vtkLookupTable> ColourScale::table() const {
  auto table = vtkSmartPointer<vtkLookupTable>::New();
  table->SetNumberOfTableValues(kTableSize);
  table->SetTableRange(lowest, highest);
  for (int i = 0; i < kTableSize; ++i) {
    const Colour colour = palette_at(palette, static_cast<double>(i) / (kTableSize - 1));
    table->SetTableValue(i, colour.red / 255.0, colour.green / 255.0, colour.blue / 255.0);
  }
  table->SetNanColor(kNoValue.red / 255.0, kNoValue.green / 255.0, kNoValue.blue / 255.0, 1.0);
  return table;
}

}  // namespace palpation::draw
