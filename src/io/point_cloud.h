/// Contacts from clouds of points, which have no names for their columns.
#pragma once

#include "io/mesh_source.h"
#include "palpation/io/contacts.h"

namespace palpation {

/// Each line's first three numbers, and the next three, a direction, where all lines have six.
ContactsFile read_xyz(const MeshSource& source, const ContactColumns& columns);

/// The vertices of a PLY.
ContactsFile read_ply_cloud(const MeshSource& source, const ContactColumns& columns);

}  // namespace palpation
