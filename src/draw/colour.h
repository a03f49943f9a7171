/// Colours, and scales that turn numbers into colours.
#pragma once

#include <vtkSmartPointer.h>

#include <string>
#include <vector>

class vtkLookupTable;

namespace palpation::draw {

struct Colour {
  unsigned char red = 0;
  unsigned char green = 0;
  unsigned char blue = 0;
  unsigned char alpha = 255;
};

inline constexpr Colour kInk{38, 38, 42};
inline constexpr Colour kGrey{118, 120, 126};
inline constexpr Colour kPaleGrey{205, 207, 212};
inline constexpr Colour kWhite{255, 255, 255};
inline constexpr Colour kTruthGreen{0, 108, 62};
inline constexpr Colour kAmber{245, 170, 20};
inline constexpr Colour kNext{226, 0, 140};
inline constexpr Colour kMissed{213, 62, 30};
inline constexpr Colour kExtra{36, 122, 190};
inline constexpr Colour kAgreement{164, 207, 190};
inline constexpr Colour kSurelyTumour{226, 138, 122};
inline constexpr Colour kUnsure{253, 219, 138};
inline constexpr Colour kCutPurple{116, 30, 140};
inline constexpr Colour kHealthy{246, 246, 243};

/// The colour at `share` of the way from a to b.
Colour mix(Colour a, Colour b, double share);

/// Easily told apart, also by people who confuse red and green; repeats after eight.
Colour curve_colour(std::size_t index);

enum class Palette {
  BlueWhiteRed,  ///< diverging: white in the middle
  Viridis,       ///< sequential, even to the eye
  WhitePurple,   ///< sequential, from nothing to certainty
};

/// Numbers from lowest to highest, mapped evenly to a palette.
struct ColourScale {
  Palette palette = Palette::Viridis;
  double lowest = 0.0;
  double highest = 1.0;

  Colour at(double value) const;
  vtkSmartPointer<vtkLookupTable> table() const;
};

}  // namespace palpation::draw
