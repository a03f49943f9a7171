/// Standard input, output and error, whatever state the program was started with.
#pragma once

namespace palpation::tool {

/// Before any file is opened. A stream that is closed gets a stand-in, so that no file of ours
/// takes its number and is written into by mistake; and a reader that went away or a limit on the
/// size of files is an error of the write, not the end of the program.
void guard_standard_streams();

/// Whether all that was printed to standard output has arrived.
bool finish_standard_output();

}  // namespace palpation::tool
