// Sums of many terms that keep their digits (Kahan 1965): what an addition loses is taken along to the next.
void addTo(inout vec4 sum, inout vec4 lost, vec4 term) {
    precise vec4 mended = term - lost;
    precise vec4 next = sum + mended;
    precise vec4 over = (next - sum) - mended;
    lost = over;
    sum = next;
}
