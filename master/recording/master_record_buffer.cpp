#include "master/recording/master_record_buffer.hpp"

namespace longreach {

template class TickBuffer<MasterRecords>;

}  // namespace longreach
