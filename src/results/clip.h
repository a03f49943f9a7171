/// Parts of a triangle mesh, cut along level lines of a field.
#pragma once

#include <string>

#include "io/vtp_shape.h"
#include "results/run.h"

namespace palpation::results {

/// All of the tissue with some of its fields, in that order; those that it does not have are left
/// out.
VtpShape model_of(const Tissue& tissue, const std::vector<std::string>& fields);

enum class Side { AtLeast, AtMost };

/// The part of a mesh where its field of that name is at least, or at most, the level: triangles
/// that the level line crosses are cut along it, and all fields are linear there. Points that no
/// triangle needs are dropped; where the field is no number there is nothing. Throws InvalidInput
/// if there is no such field.
VtpShape clipped(const VtpShape& whole, const std::string& field, double level, Side side);

double area_m2(const VtpShape& model);

}  // namespace palpation::results
