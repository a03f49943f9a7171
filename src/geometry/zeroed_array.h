/// Room for a record per element of a mesh, of which only a few will be used: memory that is not
/// touched costs nothing.
#pragma once

#include <cstdlib>
#include <memory>
#include <new>
#include <type_traits>

namespace palpation {

/// All bytes are zero at first.
template <typename Record>
class ZeroedArray {
  static_assert(std::is_trivially_copyable_v<Record>);

 public:
  explicit ZeroedArray(std::size_t count)
      : records_(static_cast<Record*>(std::calloc(count, sizeof(Record)))) {
    if (!records_) throw std::bad_alloc();
  }
  Record& operator[](std::size_t index) { return records_.get()[index]; }
  const Record& operator[](std::size_t index) const { return records_.get()[index]; }

 private:
  struct Free {
    void operator()(Record* records) const { std::free(records); }
  };
  std::unique_ptr<Record, Free> records_;
};

}  // namespace palpation
