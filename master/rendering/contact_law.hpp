#pragma once
// A law that replaces the passive springs of the contacts, for comparison. The programs contain no such law; the laboratory
// passes one to its node (MasterNode::render_by). The limits of the port remain; the energy balance is not kept.

#include "master/rendering/contact.hpp"

namespace longreach {

class ContactLaw {
 public:
  ContactLaw() = default;
  virtual ~ContactLaw() = default;
  ContactLaw(const ContactLaw&) = delete;
  ContactLaw& operator=(const ContactLaw&) = delete;

  /// Sets the force of the spring of `axis`, whose surface is known and at its place for this tick. `damping` is that of the
  /// contact, N s/m or N m s/rad. Returns the force against n_M on the hand, N or N m. Must not allocate.
  virtual double step(ContactAxis& axis, const ContactHandle& handle, double damping) const = 0;
};

}  // namespace longreach
