/// Memory that beliefs which are gone have left.
#pragma once

namespace palpation {

/// Large arrays that are freed are kept, up to 512 MiB of them in the whole process, for the belief
/// that comes next: clearing new pages takes the system as long as filling them. This gives all of
/// them back to the system. Safe at any time, from any thread.
void release_memory();

}  // namespace palpation
