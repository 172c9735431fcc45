// openapi-generator writes no C++ that compiles for a union of schemas: an environment is free-form JSON there.
#pragma once

#include "CqltlClient/Object.h"

namespace org { namespace openapitools { namespace client { namespace model {

using EnvironmentSpec = Object;

}}}}
