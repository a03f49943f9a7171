/// Sorting what falls into many small buckets. Private to this folder.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace palpation {

/// The items in the order of their buckets (numbers below bucket_count), each bucket in the order
/// of `less`. Linear where buckets are small, and never slower than a sort, whatever a file does to
/// fill one bucket.
template <typename Item, typename BucketOf, typename Less>
std::vector<Item> sorted_in_buckets(const std::vector<Item>& items, std::size_t bucket_count,
                                    BucketOf bucket_of, Less less) {
  std::vector<std::uint32_t> end(bucket_count + 1, 0);
  for (const Item& item : items) ++end[bucket_of(item) + 1];
  for (std::size_t bucket = 0; bucket < bucket_count; ++bucket) end[bucket + 1] += end[bucket];
  std::vector<Item> sorted(items.size());
  for (const Item& item : items)
    sorted[end[bucket_of(item)]++] = item;  // end[b] runs from the start of bucket b to its end
  std::uint32_t first = 0;
  for (std::size_t bucket = 0; bucket < bucket_count; ++bucket) {
    if (end[bucket] - first > 1)
      std::sort(sorted.begin() + static_cast<std::ptrdiff_t>(first),
                sorted.begin() + static_cast<std::ptrdiff_t>(end[bucket]), less);
    first = end[bucket];
  }
  return sorted;
}

}  // namespace palpation
