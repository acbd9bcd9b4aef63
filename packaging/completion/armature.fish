# SPDX-License-Identifier: Apache-2.0
# Completion of armature for fish; `armature complete` knows the words. Files are offered where it knows none.
function __armature_words
    set -l typed (commandline -opc)
    armature complete -- $typed[2..] (commandline -ct) 2>/dev/null
end
complete -c armature -f -n 'count (__armature_words) >/dev/null' -a '(__armature_words)'
complete -c armature -F -n 'not count (__armature_words) >/dev/null'
