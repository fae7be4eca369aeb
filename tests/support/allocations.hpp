#pragma once
// Counts what operator new hands out while asked to.

namespace longreach::test {

void count_allocations(bool on);  // starts from zero when switched on
long allocations();

}  // namespace longreach::test
