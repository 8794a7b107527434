#pragma once

namespace barehand {

/// Has the kernel drop LCM fragments that begin behind the end of their message, for all UDP sockets of this process
/// that are bound to a port. liblcm 1.3.1 adds such an offset to the fragment's size in 32 bits, and writes
/// outside of its buffer: two datagrams from any host of the network end every process that listens. To be called after
/// a subscription, which is when liblcm opens its socket.
void drop_damaged_fragments();

}  // namespace barehand
