#pragma once
// Counts the calls of operator new.

namespace longreach::test {

void count_allocations(bool on);  // resets the count when switched on
long allocations();

}  // namespace longreach::test
