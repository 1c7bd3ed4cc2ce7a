#pragma once

namespace algebra3d {

/// Has the memory of GMP's and MPFR's numbers counted (base/memory_limit.h), and kept from ending the process: GMP
/// cannot fail, so a number that exceeds a limit is granted and the next allocation of the thread refused; when the
/// system has no memory, a reserve of 16 MB is given away first. To be called once, before any number is made; a matter
/// of the program.
void count_number_memory();

}  // namespace algebra3d
