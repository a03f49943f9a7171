#include "boundary/simple_loops.h"

#include <algorithm>
#include <map>
#include <optional>
#include <span>
#include <utility>

namespace palpation {

namespace {

/// Only vertices can be visited twice: inside a mesh edge there is one crossing, with one line
/// through it.
class Visits {
 public:
  void note(const Place& place, std::size_t index) {
    if (place.at_vertex()) index_[place.low] = index;
  }
  void forget(const Place& place) {
    if (place.at_vertex()) index_.erase(place.low);
  }
  std::optional<std::size_t> of(const Place& place) const {
    const auto found = place.at_vertex() ? index_.find(place.low) : index_.end();
    return found == index_.end() ? std::nullopt : std::optional(found->second);
  }

 private:
  std::map<int, std::size_t> index_;
};

/// Whether two places lie on one mesh edge.
bool on_one_edge(const Place& a, const Place& b) {
  if (!a.at_vertex() && !b.at_vertex()) return a == b;
  const Place& vertex = a.at_vertex() ? a : b;
  const Place& other = a.at_vertex() ? b : a;
  return other.at_vertex() || other.low == vertex.low || other.high == vertex.low;
}

/// Two steps make a loop only across two triangles back to back; else they go along one mesh edge
/// and come back.
bool encloses_nothing(std::span<const Step> loop) {
  return loop.size() < 2 || (loop.size() == 2 && on_one_edge(loop[0].place, loop[1].place));
}

/// Cuts a walk wherever it comes back to a place.
void cut(const ClosedWalk& walk, std::vector<ClosedWalk>& loops) {
  ClosedWalk path;
  Visits visits;
  for (const Step& step : walk) {
    if (const std::optional<std::size_t> visit = visits.of(step.place)) {
      const std::span<const Step> loop = std::span(path).subspan(*visit);
      if (!encloses_nothing(loop)) loops.emplace_back(loop.begin(), loop.end());
      for (const Step& left : loop) visits.forget(left.place);
      path.resize(*visit);
    }
    visits.note(step.place, path.size());
    path.push_back(step);
  }
  if (!encloses_nothing(path)) loops.push_back(std::move(path));
}

using Piece = std::pair<int, int>;  ///< from vertex to vertex

std::optional<Piece> piece_along_edge(const ClosedWalk& loop, std::size_t i) {
  const Place& from = loop[i].place;
  const Place& to = loop[i + 1 < loop.size() ? i + 1 : 0].place;
  if (!from.at_vertex() || !to.at_vertex()) return std::nullopt;
  return Piece{from.low, to.low};
}

/// Pieces that are run through both ways, by two loops.
std::vector<Piece> pieces_run_twice(const std::vector<ClosedWalk>& loops) {
  std::vector<Piece> pieces;
  for (const ClosedWalk& loop : loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      if (const std::optional<Piece> piece = piece_along_edge(loop, i)) pieces.push_back(*piece);
    }
  }
  std::sort(pieces.begin(), pieces.end());
  std::vector<Piece> twice;
  for (const Piece& piece : pieces) {
    if (std::binary_search(pieces.begin(), pieces.end(), Piece{piece.second, piece.first}))
      twice.push_back(piece);
  }
  return twice;
}

/// The loop without the pieces, in chains from vertex to vertex. False, and no chain, if it has
/// none of them.
bool break_open(const ClosedWalk& loop, const std::vector<Piece>& pieces,
                std::vector<ClosedWalk>& chains) {
  std::vector<std::size_t> ends;  // steps after which a piece is left out
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const std::optional<Piece> piece = piece_along_edge(loop, i);
    if (piece && std::binary_search(pieces.begin(), pieces.end(), *piece)) ends.push_back(i);
  }
  for (std::size_t k = 0; k < ends.size(); ++k) {
    ClosedWalk chain;
    for (std::size_t i = (ends[k] + 1) % loop.size(); i != ends[(k + 1) % ends.size()];
         i = (i + 1) % loop.size())
      chain.push_back(loop[i]);
    chain.push_back(loop[ends[(k + 1) % ends.size()]]);
    if (chain.size() > 1) chains.push_back(std::move(chain));
  }
  return !ends.empty();
}

/// As many chains begin at a vertex as end there, so a walk that goes on while it can comes back to
/// where it began.
std::vector<ClosedWalk> joined(const std::vector<ClosedWalk>& chains) {
  std::map<int, std::vector<std::size_t>> from;
  for (std::size_t i = chains.size(); i-- > 0;) from[chains[i].front().place.low].push_back(i);
  std::vector<bool> done(chains.size(), false);
  std::vector<ClosedWalk> walks;
  for (std::size_t start = 0; start < chains.size(); ++start) {
    if (done[start]) continue;
    ClosedWalk walk;
    for (std::vector<std::size_t>* next = &from[chains[start].front().place.low]; !next->empty();) {
      const std::size_t chain = next->back();
      next->pop_back();
      done[chain] = true;
      walk.insert(walk.end(), chains[chain].begin(), chains[chain].end() - 1);
      next = &from[chains[chain].back().place.low];
    }
    walks.push_back(std::move(walk));
  }
  return walks;
}

}  // namespace

std::vector<ClosedWalk> simple_loops(const std::vector<ClosedWalk>& walks) {
  std::vector<ClosedWalk> loops;
  for (const ClosedWalk& walk : walks) cut(walk, loops);
  const std::vector<Piece> twice = pieces_run_twice(loops);
  if (twice.empty()) return loops;

  std::vector<ClosedWalk> kept;
  std::vector<ClosedWalk> chains;
  for (ClosedWalk& loop : loops) {
    if (!break_open(loop, twice, chains)) kept.push_back(std::move(loop));
  }
  for (const ClosedWalk& walk : joined(chains)) cut(walk, kept);
  return kept;
}

}  // namespace palpation
