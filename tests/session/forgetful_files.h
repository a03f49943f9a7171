/// Files in memory that forget, as a machine does whose power fails: bytes that were not synced,
/// names that stand in folders that were not. A death comes after as many operations as one says.
#pragma once

#include <map>
#include <memory>
#include <set>
#include <string>

#include "palpation/base/error.h"
#include "palpation/base/random.h"
#include "session/file_layer.h"

namespace palpation {

/// Thrown through all that runs: no program catches its own end.
struct Death {};

/// What is left of what was not synced.
enum class Left {
  All,  ///< the process died, the machine did not
  Nothing,
  Part,  ///< of what was appended, a beginning
  Holes  ///< its length, and NUL bytes for a part of it
};

class ForgetfulFiles : public FileLayer {
 public:
  using Path = std::filesystem::path;

  /// Dies after this many operations more; an operation that appends may be cut in its middle.
  void die_after(int operations, bool in_the_middle = false) {
    left_ = operations;
    in_the_middle_ = in_the_middle;
  }
  int operations() const { return operations_; }
  std::string& content(const Path& path) { return nodes_.at(path).content; }

  /// What is there when the machine, or the process, starts again.
  void start_again(Left left, Random& random) {
    left_ = -1;
    lock_.reset();
    if (left == Left::All) return;
    std::erase_if(nodes_, [](const auto& entry) { return !entry.second.name_is_synced; });
    std::erase_if(nodes_, [&](const auto& entry) { return !stands(entry.first.parent_path()); });
    for (auto& [path, node] : nodes_) node.content = node.synced = remains(node, left, random);
  }

  bool exists(const Path& path) override {
    const bool is_there = stands(path);
    return is_there;
  }
  void make_folder(const Path& path) override {
    if (!stands(path)) put(path).is_folder = true;
    count();
  }
  std::string read(const Path& path) override {
    const auto node = nodes_.find(path);
    if (node == nodes_.end()) throw IoError(path.string() + ": is not there");
    return node->second.content;
  }
  void append(const Path& path, std::string_view bytes) override {
    Node& node = put(path);
    const bool is_last = left_ == 1 && in_the_middle_;
    node.content += bytes.substr(0, is_last ? bytes.size() / 2 : bytes.size());
    count();
  }
  void truncate(const Path& path, std::uintmax_t size) override {
    nodes_.at(path).content.resize(size);
    count();
  }
  void sync(const Path& path) override {
    nodes_.at(path).synced = nodes_.at(path).content;
    count();
  }
  void sync_folder(const Path& path) override {
    for (auto& [name, node] : nodes_) {
      if (name.parent_path() == path && name != path) node.name_is_synced = true;
    }
    count();
  }
  std::shared_ptr<void> lock(const Path& folder) override {
    if (!lock_.expired()) throw WriteError(folder.string() + ": another is writing there");
    const auto held = std::make_shared<int>(0);
    lock_ = held;
    return held;
  }

 private:
  struct Node {
    bool is_folder = false;
    bool name_is_synced = false;
    std::string content, synced;
  };

  /// The root, and where one is, are always there.
  bool stands(const Path& path) const {
    return path.empty() || path == path.root_path() || nodes_.contains(path);
  }
  Node& put(const Path& path) {
    if (!stands(path.parent_path())) throw WriteError(path.string() + ": there is no such folder");
    return nodes_[path];
  }
  void count() {
    ++operations_;
    if (left_ > 0 && --left_ == 0) throw Death();
  }
  static std::string remains(const Node& node, Left left, Random& random) {
    if (!node.content.starts_with(node.synced)) return node.synced;  // a cut that was not synced
    std::string fresh = node.content.substr(node.synced.size());
    const auto at = [&] {
      return static_cast<std::size_t>(random.below(static_cast<int>(fresh.size()) + 1));
    };
    if (left == Left::Nothing) fresh.clear();
    if (left == Left::Part) fresh.resize(at());
    if (left == Left::Holes) {
      const std::size_t first = at(), second = at();
      for (std::size_t i = std::min(first, second); i < std::max(first, second); ++i) fresh[i] = 0;
    }
    return node.synced + fresh;
  }

  std::map<Path, Node> nodes_;
  std::weak_ptr<void> lock_;
  int left_ = -1;
  bool in_the_middle_ = false;
  int operations_ = 0;
};

}  // namespace palpation
