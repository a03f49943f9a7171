#include "certainty/outline_pieces.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/targets.h"

namespace palpation {
namespace {

constexpr int kAtOnce = 64;

/// Columns of pieces, from one of them on.
struct Columns {
  const double *from_x, *from_y, *to_y, *along_x, *along_y, *inverse_square;
};

PALPATION_TARGETS
void square_distances(const Columns& pieces, int count, double x, double y, double* squares) {
  for (int i = 0; i < count; ++i) {
    const double away_x = x - pieces.from_x[i], away_y = y - pieces.from_y[i];
    const double ahead =
        (pieces.along_x[i] * away_x + pieces.along_y[i] * away_y) * pieces.inverse_square[i];
    const double part = std::min(std::max(ahead, 0.0), 1.0);
    const double off_x = away_x - part * pieces.along_x[i],
                 off_y = away_y - part * pieces.along_y[i];
    squares[i] = off_x * off_x + off_y * off_y;
  }
}

PALPATION_TARGETS
long crossings(const Columns& pieces, int count, double x, double y) {
  long sum = 0;
  for (int i = 0; i < count; ++i) {
    const double away_x = x - pieces.from_x[i], away_y = y - pieces.from_y[i];
    const bool falls = pieces.from_y[i] > y, ends = pieces.to_y[i] > y,
               left = pieces.along_x[i] * away_y - pieces.along_y[i] * away_x > 0.0;
    sum += static_cast<long>(falls != ends) & static_cast<long>(falls != left);
  }
  return sum;
}

}  // namespace

OutlinePieces::OutlinePieces(const OutlineNodes& outline)
    : from_x_(outline.place.size()),
      from_y_(outline.place.size()),
      to_y_(outline.place.size()),
      along_x_(outline.place.size()),
      along_y_(outline.place.size()),
      inverse_square_(outline.place.size()) {
  for (int node = 0; node < outline.count(); ++node)
    set(node, outline.place[node], outline.place[outline.next(node)]);
}

void OutlinePieces::set(int piece, const Vec2& from, const Vec2& to) {
  const Vec2 along = to - from;
  const double square = along.squaredNorm();
  from_x_[piece] = from.x();
  from_y_[piece] = from.y();
  to_y_[piece] = to.y();
  along_x_[piece] = along.x();
  along_y_[piece] = along.y();
  inverse_square_[piece] = square > 0.0 ? 1.0 / square : 0.0;
}

NearestPiece OutlinePieces::nearest(const Vec2& place) const {
  NearestPiece nearest{.square = 1e300};
  std::array<double, kAtOnce> squares;
  const int count = static_cast<int>(from_x_.size());
  for (int first = 0; first < count; first += kAtOnce) {
    const Columns columns{&from_x_[first],  &from_y_[first],  &to_y_[first],
                          &along_x_[first], &along_y_[first], &inverse_square_[first]};
    const int here = std::min(kAtOnce, count - first);
    square_distances(columns, here, place.x(), place.y(), squares.data());
    for (int i = 0; i < here; ++i) {
      if (squares[i] < nearest.square) nearest = {squares[i], first + i};
    }
  }
  return nearest;
}

bool OutlinePieces::encloses(const Vec2& place) const {
  const Columns columns{from_x_.data(),  from_y_.data(),  to_y_.data(),
                        along_x_.data(), along_y_.data(), inverse_square_.data()};
  const int count = static_cast<int>(from_x_.size());
  return crossings(columns, count, place.x(), place.y()) % 2 != 0;
}

double OutlinePieces::depth_at(const Vec2& place) const {
  const double off_m = std::sqrt(nearest(place).square);
  return encloses(place) ? off_m : -off_m;
}

}  // namespace palpation
