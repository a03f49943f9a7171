/// A world in the making, and what it may be made of.
#pragma once

#include <string>
#include <utility>

#include "palpation/base/random.h"
#include "palpation/world/catalogue.h"
#include "palpation/world/random_shape.h"
#include "world/shape_curves.h"

namespace palpation {

/// Of all that is drawn at random for it.
struct Draft {
  Random& random;
  const WorldArea& area;
  DrawnWorld world{};

  double between(double least, double most) { return uniform(random, least, most); }
  /// So far from every side at least. Throws InvalidInput where tissue has no room for that.
  Vec3 anywhere(double margin_m);
  Vec3 direction();
  Lump& add(Tumour outline);
};

Lump& add_shape(Draft& draft, ShapeFamily family);
Lump& add_blob(Draft& draft);
/// Of such a radius, metres.
Lump& add_disk(Draft& draft, double least_m, double most_m);
void add_ring(Draft& draft);
/// Its centre lies on the longer side.
void add_over_border(Draft& draft);
/// Nodules of 9 mm, apart by 2 mm at least. Throws InvalidInput where they do not fit.
void add_nodules(Draft& draft, int count);
/// Two disks that overlap, the second of so much of the first one's contrast.
void add_touching(Draft& draft, double contrast);
/// A disk, and a wider one of so much of its contrast that holds it.
void add_cored(Draft& draft, double contrast);
/// Of so much of a tumour's contrast.
void add_vessel(Draft& draft, double height);
void add_wave(Draft& draft, double height);
/// Of 30 to 150 % of a tumour's contrast from side to side.
void add_tilt(Draft& draft);

}  // namespace palpation
