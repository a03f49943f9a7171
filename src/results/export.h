/// A run as other programs expect it: their unit, their frame, their kinds of files.
#pragma once

#include <map>
#include <string>

#include "results/run.h"

namespace palpation::results {

enum class Program {
  Slicer,    ///< 3D Slicer: models in millimetres that say RAS or LPS, touches as markups
  ParaView,  ///< models in metres and a list of them
  Csv,       ///< tables whose columns name their units
};

/// "slicer", "paraview" or "csv"; throws InvalidInput for anything else.
Program program_of(const std::string& name);
std::string name_of(Program program);

/// The files by name. What was not found or not felt makes no file. Throws InvalidInput where 3D
/// Slicer is asked for in the mesh's own frame: what it shows would be mirrored, or not.
std::map<std::string, std::string> exported(const Run& run, Program program, Frame frame);

}  // namespace palpation::results
