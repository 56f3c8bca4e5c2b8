# Reads a kernel as spirv-dis prints it with --raw-id --no-header. Prints the same kernel with an entry point that returns at once.
# Buffers, push constants, specialization constants and the size of workgroups stay, so hosts dispatch it as they do the other.
$1 == "OpEntryPoint" { entry = $3 }
inside && $1 == "OpFunctionEnd" { inside = 0 }
inside && $3 == "OpLabel" && !entered { entered = 1; line[++lines] = $0; line[++lines] = "OpReturn"; next }
inside { gone[$1] = 1; next }
{ line[++lines] = $0 }
$3 == "OpFunction" && $1 == entry { inside = 1 }
END {
  for (k = 1; k <= lines; ++k) {
    split(line[k], word)
    if ((word[1] == "OpName" || word[1] == "OpDecorate") && word[2] in gone) continue
    print line[k]
  }
}
