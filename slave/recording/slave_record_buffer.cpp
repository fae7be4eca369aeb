#include "slave/recording/slave_record_buffer.hpp"

namespace longreach {

template class TickBuffer<SlaveRecords>;

}  // namespace longreach
