/// A scene of 3D Slicer, .mrml: the files of an export, to be opened in one go and in colour.
#pragma once

#include <string>
#include <vector>

#include "results/run.h"
#include "results/shown.h"

namespace palpation::results {

inline constexpr const char* kSlicerScene = "palpation.mrml";

/// Names the files `NAME.vtp` of the models, which are those of an export, and `NAME.mrk.json` of
/// the lists, as far as they hold any marks. The tissue is coloured by its mean, between the limits
/// of the pictures; what was not searched is a net over it, and lines have the colours of the
/// report. Tumour and band lie in the tissue's own surface: they are there, and hidden until their
/// eye is opened. Throws InvalidInput unless the frame is RAS or LPS.
std::string slicer_scene(const Run& run, const std::vector<std::string>& models,
                         const std::vector<NamedMarks>& lists, Frame frame);

}  // namespace palpation::results
