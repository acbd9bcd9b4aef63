// SPDX-License-Identifier: Apache-2.0
// npm's canopen without node-crc, which would have to be compiled: block transfers need it, and no test has any.
const Module = require('node:module');
const load = Module._load;
Module._load = (request, ...others) => (request === 'node-crc' ? {} : load(request, ...others));
module.exports = require('canopen');
Module._load = load;
