/// Threads over independent pieces of work. What a piece computes never depends on how many threads
/// there are, so neither do the results.
#pragma once

#include <functional>

namespace palpation {

/// How many threads the library may use, for the whole process: at least 1; by default the
/// machine's cores.
void set_thread_count(int count);
int thread_count();

/// Calls work(first, last) for consecutive ranges that cover [0, count), each a multiple of grain
/// long but for the last. The ranges depend on count, grain and nothing else that matters to the
/// result: work must write only to what its range owns. The first exception thrown by any range is
/// thrown here. Calls from inside work run in that thread.
void for_ranges(int count, int grain, const std::function<void(int first, int last)>& work);

}  // namespace palpation
