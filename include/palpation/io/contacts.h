/// Where a probe met the tissue, or a cloud of points on it, from files: CSV, XYZ (one point a
/// line, numbers apart by blanks) and PLY (its faces, if any, are ignored), recognized by content.
///
/// Of a CSV the columns are those that are asked for, else contact_x, contact_y, contact_z, else x,
/// y, z. Their unit is asked for, or ends their name (x_mm; mm, cm or m), or else metres, as all of
/// this project's CSV files are; of XYZ and PLY it must be asked for. Rows without a finite number
/// in one of them, of kind "missed", or with a word in set_aside are left out and counted.
///
/// Which side is out: by the columns normal_x, normal_y, normal_z (unit, outward), or nx, ny, nz of
/// a table of readings (probed_csv), else by the mean of fx, fy, fz (with a unit or without), the
/// force that the probe felt, which points out of the tissue; of XYZ by the fourth to sixth number
/// of every line. Nothing else tells, as nx, ny, nz is outward in some files and the probe's axis
/// in others: then `outward` is empty.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "palpation/base/types.h"
#include "palpation/io/read_mesh.h"

namespace palpation {

struct ContactColumns {
  std::optional<LengthUnit> unit{};
  std::vector<std::string> position{};  ///< three names, or none
  std::vector<std::string> outward{};   ///< three names, or none
};

struct ContactsFile {
  Points points;                     ///< metres
  Points outward;                    ///< as many directions, not zero, or none
  std::string outward_from;          ///< what told, in words; empty if nothing did
  std::vector<int> places;           ///< of each point, its line; in a PLY its vertex, from 0
  std::string place_word = "line";   ///< "line" or "vertex"
  std::string unit_words;            ///< in what unit the file was read, and why
  std::vector<std::string> remarks;  ///< plain sentences: rows left out
};

/// Throws IoError, naming line, column, value and rule, for what breaks the above, and where the
/// size is not tissue's: between 1 mm and 2 m across.
ContactsFile read_contacts(const std::filesystem::path& path, const ContactColumns& columns = {});

}  // namespace palpation
