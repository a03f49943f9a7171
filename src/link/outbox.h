/// What a client is still to be sent.
///
/// Laws: (1) it holds no more than one message that is under way and the latest of each name, so it
/// is bounded however slow the client is; (2) a message that has begun is sent to its end; (3) the
/// order is that in which names came.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace palpation::link {

/// Shared by all clients: packed once.
using SharedBytes = std::shared_ptr<const std::string>;

class Outbox {
 public:
  /// In the place of an earlier one of that name that has not begun.
  void put(const std::string& name, SharedBytes message);
  bool is_empty() const { return !under_way_ && waiting_.empty(); }
  /// What may be sent now; empty if nothing is left.
  std::string_view next();
  /// So many bytes of that were taken.
  void sent(std::size_t bytes);

 private:
  SharedBytes under_way_;
  std::size_t sent_ = 0;  // bytes of it
  std::vector<std::pair<std::string, SharedBytes>> waiting_;
};

}  // namespace palpation::link
