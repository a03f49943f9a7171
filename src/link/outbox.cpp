#include "link/outbox.h"

#include <algorithm>

namespace palpation::link {

void Outbox::put(const std::string& name, SharedBytes message) {
  const auto same = std::ranges::find(waiting_, name, [](const auto& one) { return one.first; });
  if (same != waiting_.end())
    same->second = std::move(message);
  else
    waiting_.emplace_back(name, std::move(message));
}

std::string_view Outbox::next() {
  if (!under_way_ && !waiting_.empty()) {
    under_way_ = std::move(waiting_.front().second);
    waiting_.erase(waiting_.begin());
    sent_ = 0;
  }
  return under_way_ ? std::string_view(*under_way_).substr(sent_) : std::string_view();
}

void Outbox::sent(std::size_t bytes) {
  sent_ += bytes;
  if (under_way_ && sent_ >= under_way_->size()) under_way_.reset();
}

}  // namespace palpation::link
