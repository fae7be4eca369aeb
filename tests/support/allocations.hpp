#pragma once
// Counts the calls to operator new while counting is switched on.

namespace longreach::test {

void count_allocations(bool on);  // switching it on resets the count
long allocations();

}  // namespace longreach::test
