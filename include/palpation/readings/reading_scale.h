/// The scale on which readings are modelled: as they are, or by their logarithm.
///
/// Stiffness of real tissue is positive and skewed: what is three times as stiff is as far from
/// healthy as what is three times as soft. On the raw scale one high reading then outweighs a
/// nodule.
#pragma once

#include <vector>

#include "palpation/readings/palpation.h"

namespace palpation {

enum class ReadingScale { Raw, Log };

/// A reading on that scale; its natural logarithm, of a positive one.
double on_scale(ReadingScale scale, double reading);
/// And back.
double as_reading(ReadingScale scale, double value);
/// How far in readings a small step at a value goes.
double reading_per_step(ReadingScale scale, double value);

/// The same with noise variances to first order. On the logarithmic scale a reading that is not
/// positive is lost contact, and set aside as that.
std::vector<Palpation> on_scale(ReadingScale scale, std::vector<Palpation> palpations);

}  // namespace palpation
