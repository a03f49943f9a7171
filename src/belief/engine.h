/// What the readings tell of places, before the constant and the slope are counted (regression.h).
/// Two engines tell it: rows for every site (exact_engine.h), and features in their place
/// (reduced_engine.h). Variances are over the signal's.
#pragma once

#include <memory>
#include <vector>

#include "belief/regression.h"
#include "belief/rows.h"
#include "belief/vertex_tiles.h"

namespace palpation {

/// Of one place, with v = L^-1 k(sites, place).
struct Seen {
  double unexplained = 1.0;  // 1 - v'v
  double ones = 0.0;         // v' L^-1 1
  double readings = 0.0;     // v' L^-1 (y - origin)
  Vec3 tilts = Vec3::Zero();
};

class Engine {
 public:
  virtual ~Engine() = default;

  virtual int site_count() const = 0;
  const Whitened& whitened() const { return whitened_; }

  virtual Seen look_at(const Prior& prior, const Place& place) const = 0;
  /// At the vertices; null without a site.
  const VertexSums* sums() const { return sums_.get(); }
  /// 1 - v'v of the vertices of a tile.
  virtual void unexplained(const VertexTiles& tiles, int tile, double* of_lanes) const = 0;

  /// The correlation of the field with a vertex, once the readings are known, is the prior's less
  /// these rows weighed by the vertex's column of them, ...
  virtual std::vector<TileRows> rows() const = 0;
  virtual std::vector<double> column(const VertexTiles& tiles, int vertex) const = 0;
  /// ... no more than what the variances of both allow.
  virtual double held(double correlation, int, int) const { return correlation; }

  /// 1 - v'L^-1 1 and v'L^-1 t of a vertex.
  double residual_ones(const VertexTiles& tiles, int vertex) const {
    return sums_ ? 1.0 - sums_->at(tiles.place(vertex), VertexSums::kOnes) : 1.0;
  }
  Vec3 tilts(const VertexTiles& tiles, int vertex) const {
    if (!sums_) return Vec3::Zero();
    const int place = tiles.place(vertex);
    return {sums_->at(place, VertexSums::kTilts), sums_->at(place, VertexSums::kTilts + 1),
            sums_->at(place, VertexSums::kTilts + 2)};
  }

  /// `sum` and the logarithm of |K + D|, and of the density of the readings given those merged.
  virtual double plus_log_determinant(double sum) const = 0;
  virtual double plus_scatter(double sum, double noise_variance) const = 0;

 protected:
  Whitened whitened_;
  std::shared_ptr<const VertexSums> sums_;
};

}  // namespace palpation
