// SPDX-License-Identifier: Apache-2.0
declare module "*.urdf" {
  const text: string;
  export default text;
}
