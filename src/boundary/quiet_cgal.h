/// While one of these lives, in any thread, CGAL's failed checks throw and print nothing; the
/// handlers that were there come back with the last.
#pragma once

namespace palpation {

class QuietCgal {
 public:
  QuietCgal();
  ~QuietCgal();
  QuietCgal(const QuietCgal&) = delete;
  QuietCgal& operator=(const QuietCgal&) = delete;
};

}  // namespace palpation
