#pragma once

namespace barehand {

/// From now on, up to 64 MB of freed memory stay with this process, and every thread may reuse them; 24 MB are reserved
/// at once. Otherwise the first frames with a hand would wait for pages that the kernel has to clear, since other
/// threads and the loading of networks freed theirs. Call it before other threads start. Does nothing without the GNU
/// C library.
void keep_freed_memory();

}  // namespace barehand
